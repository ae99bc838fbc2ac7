// Finds the vertices that need more rays.
#include "compressor/bake/noise_target.h"

#include <cmath>

#include "paim/base/check.h"

namespace paim {

std::vector<uint32_t> above_noise_target(const Topology& topology,
                                         std::span<const double> noise_energy,
                                         std::span<const uint64_t> num_rays, double power,
                                         double target_energy,
                                         std::span<const uint32_t> candidates) {
    PAIM_CHECK_EQ(noise_energy.size(), topology.num_vertices);
    PAIM_CHECK_EQ(num_rays.size(), topology.num_vertices);
    // Squared error of one ray divided by that of all rays.
    std::vector<double> falls(topology.num_vertices);
    for (size_t v = 0; v < falls.size(); ++v) {
        falls[v] = std::pow(static_cast<double>(num_rays[v]), power);
    }
    // Sums over triangles, so that inner neighbours count twice and those along a border once.
    std::vector<double> sums(topology.num_vertices, 0.0);
    std::vector<uint32_t> counts(topology.num_vertices, 0);
    for (const Triangle& t : topology.triangles) {
        for (size_t corner = 0; corner < 3; ++corner) {
            for (const uint32_t neighbour : {t[(corner + 1) % 3], t[(corner + 2) % 3]}) {
                if (num_rays[neighbour] == 0 || neighbour == t[corner]) continue;
                sums[t[corner]] += noise_energy[neighbour] * falls[neighbour];
                ++counts[t[corner]];
            }
        }
    }
    std::vector<uint32_t> above;
    for (const uint32_t v : candidates) {
        const double of_one_ray = counts[v] > 0 ? sums[v] / counts[v] : noise_energy[v] * falls[v];
        if (of_one_ray > target_energy * falls[v]) above.push_back(v);
    }
    return above;
}

}  // namespace paim
