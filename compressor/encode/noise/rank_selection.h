// How many components to keep.
#pragma once

#include <cstdint>
#include <span>

#include "compressor/encode/noise/component_noise.h"
#include "compressor/encode/options.h"

namespace paim {

// Of data without noise: `automatic` keeps the fewest with √(Σ dropped s² / Σ s²) below the error.
// rank  how many there are
uint32_t choose_components(const ComponentChoice& choice, std::span<const double> singular_values,
                           uint32_t rank, double automatic_energy_error);

// √(Σ dropped signal / Σ signal) over the components that stand out from noise, if K of them are
// kept; what lies below the noise cannot be had, so it does not count. 0 where there is no signal.
double signal_error(const ComponentNoise& noise, uint32_t num_components);

// Of data with noise: `automatic` does the same with the signal in each component, and never keeps
// one that does not stand out from noise.
uint32_t choose_components(const ComponentChoice& choice, const ComponentNoise& noise,
                           double automatic_energy_error);

// The fewest of `all` components whose rest is at most `most`, in what energy_of(k) is of component k.
template <typename EnergyOf>
uint32_t components_for(uint32_t all, double most, const EnergyOf& energy_of) {
    double dropped = 0.0;
    uint32_t k = all;
    while (k > 0 && dropped + energy_of(k - 1) <= most) dropped += energy_of(--k);
    return k;
}

}  // namespace paim
