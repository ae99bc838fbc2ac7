// How far shadow rays start off the surface.
#include "compressor/bake/ray_offset.h"

#include <algorithm>
#include <limits>

#include "paim/base/check.h"

namespace paim {

std::vector<float> ray_offsets(const Topology& topology, std::span<const Vec3f> positions,
                               double of_edge) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    constexpr float kOfCoordinate = 4.0f * std::numeric_limits<float>::epsilon();
    std::vector<double> sums(positions.size(), 0.0);
    std::vector<uint32_t> counts(positions.size(), 0);
    for (const Triangle& t : topology.triangles) {
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t a = t[corner];
            const uint32_t b = t[(corner + 1) % 3];
            const double length =
                (positions[a].cast<double>() - positions[b].cast<double>()).stableNorm();
            if (length == 0.0) continue;  // a collapsed edge says nothing about the detail
            for (const uint32_t v : {a, b}) {
                sums[v] += length;
                ++counts[v];
            }
        }
    }
    std::vector<float> offsets(positions.size());
    for (size_t v = 0; v < positions.size(); ++v) {
        const double mean = counts[v] > 0 ? sums[v] / counts[v] : 0.0;
        offsets[v] = std::max(static_cast<float>(of_edge * mean),
                              kOfCoordinate * positions[v].cwiseAbs().maxCoeff());
    }
    return offsets;
}

}  // namespace paim
