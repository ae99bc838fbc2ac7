// Which vertices need more rays.
#include "compressor/bake/noise_target.h"

#include "paim/base/check.h"

namespace paim {

std::vector<uint32_t> above_noise_target(const Topology& topology,
                                         std::span<const double> noise_energy, double target_energy,
                                         std::span<const uint32_t> candidates) {
    PAIM_CHECK_EQ(noise_energy.size(), topology.num_vertices);
    // Over triangles, so that inner neighbours count twice and those along a border once.
    std::vector<double> sums(topology.num_vertices, 0.0);
    std::vector<uint32_t> counts(topology.num_vertices, 0);
    for (const Triangle& t : topology.triangles) {
        for (size_t corner = 0; corner < 3; ++corner) {
            sums[t[corner]] +=
                noise_energy[t[(corner + 1) % 3]] + noise_energy[t[(corner + 2) % 3]];
            counts[t[corner]] += 2;
        }
    }
    std::vector<uint32_t> above;
    for (const uint32_t v : candidates) {
        const bool neighbours_met = sums[v] <= target_energy * counts[v];
        if (noise_energy[v] > target_energy || !neighbours_met) above.push_back(v);
    }
    return above;
}

}  // namespace paim
