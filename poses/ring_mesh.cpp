// Strips between rings.
#include "poses/ring_mesh.h"

#include <utility>

#include "paim/base/check.h"

namespace paim::poses {

namespace {

void add(uint32_t a, uint32_t b, uint32_t c, Facing facing, std::vector<Triangle>& triangles) {
    if (facing == Facing::inward) std::swap(b, c);
    triangles.push_back({a, b, c});
}

}  // namespace

void stitch_rings(const Ring& outer, const Ring& inner, Facing facing,
                  std::vector<Triangle>& triangles) {
    const size_t size = inner.size();
    if (outer.size() == size) {
        for (size_t j = 0; j < size; ++j) {
            const size_t next = (j + 1) % size;
            add(outer[j], outer[next], inner[j], facing, triangles);
            add(outer[next], inner[next], inner[j], facing, triangles);
        }
        return;
    }
    PAIM_CHECK_EQ(outer.size(), 2 * size);
    for (size_t j = 0; j < size; ++j) {
        const size_t next = (j + 1) % size;
        add(outer[2 * j], outer[2 * j + 1], inner[j], facing, triangles);
        add(outer[2 * j + 1], inner[next], inner[j], facing, triangles);
        add(outer[2 * j + 1], outer[2 * next], inner[next], facing, triangles);
    }
}

void close_ring(const Ring& ring, uint32_t pole, Facing facing, std::vector<Triangle>& triangles) {
    for (size_t j = 0; j < ring.size(); ++j) {
        add(ring[j], ring[(j + 1) % ring.size()], pole, facing, triangles);
    }
}

}  // namespace paim::poses
