// Finds the vertices that need more rays, and how many.
#include "compressor/bake/noise_target.h"

#include <cmath>

#include "paim/base/check.h"

namespace paim {

std::vector<RayDemand> above_noise_target(const Neighbours& neighbours,
                                          std::span<const double> noise_energy,
                                          std::span<const double> information, double power,
                                          double target_energy,
                                          std::span<const uint32_t> candidates) {
    PAIM_CHECK_EQ(noise_energy.size(), neighbours.num_vertices());
    PAIM_CHECK_EQ(information.size(), neighbours.num_vertices());
    std::vector<RayDemand> above;
    for (const uint32_t v : candidates) {
        // Squared error of a vertex with information 1.
        double sum = 0.0;
        size_t count = 0;
        for (const uint32_t neighbour : neighbours[v]) {
            if (information[neighbour] == 0.0) continue;
            sum += noise_energy[neighbour] * information[neighbour];
            ++count;
        }
        const double energy =
            count > 0 ? sum / static_cast<double>(count) : noise_energy[v] * information[v];
        if (energy > target_energy * information[v]) {
            above.push_back({v, std::pow(energy / target_energy - information[v], 1.0 / power)});
        }
    }
    return above;
}

}  // namespace paim
