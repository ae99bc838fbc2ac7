// Estimates the energy of the transfer in bands that a bake does not have.
#pragma once

#include <span>

#include "paim/metrics/band_power.h"

namespace paim {

// The amplitude A of the energy A (l + ½)^-2 of band l. Functions on the sphere that are
// discontinuous along curves have such energies, and diffuse transfer is discontinuous at the edges
// of shadows. A is the mean over the last two bands, without bands below l = 3, where the smooth
// lobes of open vertices dominate. For bakes without bands from l = 3 on it is the value of the
// last band, which is several times too large.
// energy  [bands >= 1] of the bake, without noise
double missing_band_amplitude(std::span<const double> energy);

// Energy in all bands that the bake does not have, weighted by the light's band power.
double missing_band_energy(std::span<const double> energy, const BandPower& spectrum);

}  // namespace paim
