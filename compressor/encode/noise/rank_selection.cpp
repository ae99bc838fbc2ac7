// How many components to keep.
#include "compressor/encode/noise/rank_selection.h"

#include <algorithm>
#include <cmath>

#include "paim/metrics/singular_value_error.h"

namespace paim {

uint32_t choose_components(const ComponentChoice& choice, std::span<const double> singular_values,
                           uint32_t rank, double automatic_energy_error) {
    switch (choice.kind) {
        case ComponentChoice::Kind::all:
            return rank;
        case ComponentChoice::Kind::number:
            return std::min(choice.number, rank);
        case ComponentChoice::Kind::automatic:
            break;
    }
    uint32_t k = 0;
    while (k < rank && energy_error(singular_values, k) >= automatic_energy_error) ++k;
    return k;
}

double signal_error(const ComponentNoise& noise, uint32_t num_components) {
    double all = 0.0;
    double dropped = 0.0;
    for (uint32_t k = 0; k < noise.num_above_noise; ++k) {
        all += noise.signal_of(k);
        if (k >= num_components) dropped += noise.signal_of(k);
    }
    return all > 0.0 ? std::sqrt(dropped / all) : 0.0;
}

uint32_t choose_components(const ComponentChoice& choice, const ComponentNoise& noise,
                           double automatic_energy_error) {
    const auto rank = static_cast<uint32_t>(noise.energy.cols());
    if (choice.kind != ComponentChoice::Kind::automatic) {
        return choose_components(choice, {}, rank, automatic_energy_error);
    }
    const uint32_t most = noise.num_above_noise;
    uint32_t k = 0;
    while (k < most && signal_error(noise, k) >= automatic_energy_error) ++k;
    return k;
}

}  // namespace paim
