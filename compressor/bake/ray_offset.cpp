// Distance of the start of shadow rays from the surface.
#include "compressor/bake/ray_offset.h"

#include <algorithm>
#include <limits>

#include "paim/base/check.h"
#include "paim/mesh/normals.h"

namespace paim {

std::vector<float> ray_offsets(const Topology& topology, std::span<const Vec3f> positions,
                               const RayOffsetRule& rule) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::vector<double> shortest(positions.size(), kNone);  // edge
    std::vector<float> largest(positions.size(), 0.0f);     // coordinate
    for (const Triangle& t : topology.triangles) {
        // Faces without area cannot be hit, and do not show the size of details of the surface.
        if (face_normal(positions[t[0]], positions[t[1]], positions[t[2]]).isZero(0.0)) continue;
        // The place where a ray crosses a face depends on all three corners.
        float coordinate = 0.0f;
        for (const uint32_t v : t) {
            coordinate = std::max(coordinate, positions[v].cwiseAbs().maxCoeff());
        }
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t a = t[corner];
            const uint32_t b = t[(corner + 1) % 3];
            const double length =
                (positions[a].cast<double>() - positions[b].cast<double>()).stableNorm();
            for (const uint32_t v : {a, b}) shortest[v] = std::min(shortest[v], length);
            largest[a] = std::max(largest[a], coordinate);
        }
    }
    std::vector<float> offsets(positions.size(), 0.0f);
    for (size_t v = 0; v < positions.size(); ++v) {
        if (shortest[v] == kNone) continue;
        const double rounding = std::numeric_limits<float>::epsilon() * double{largest[v]};
        offsets[v] =
            static_cast<float>(std::max(rule.of_edge * shortest[v], rule.of_coordinate * rounding));
    }
    return offsets;
}

}  // namespace paim
