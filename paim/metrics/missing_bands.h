// How much transfer there is in bands that a bake does not have.
#pragma once

#include <span>

#include "paim/metrics/band_power.h"

namespace paim {

// The amplitude A of A (l + ½)^-2, the energy per band of everything on the sphere that jumps along
// curves, as diffuse transfer does where shadows begin. It is the mean over the last two bands,
// without those before l = 3, where the smooth lobes of open vertices dominate; of bakes that end
// before it, what the last band says, which is several times too much.
// energy  [bands >= 1] of the bake, without noise
double missing_band_amplitude(std::span<const double> energy);

// Energy in all bands that the bake does not have, weighted by the light's spectrum.
double missing_band_energy(std::span<const double> energy, const BandPower& spectrum);

}  // namespace paim
