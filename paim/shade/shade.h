// Reference shading on the CPU: radiance of every vertex under a light.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002
#pragma once

#include <span>
#include <vector>

#include "paim/light/light.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// radiance(o, v) = albedo(v) · Σ_i t_oi(v) L_i, per channel, for each outgoing coefficient o. Bands
// that the light or the transfer does not have are zero.
// transfer  [layout.num_planes()][V]
// radiance  [layout.num_outgoing()][V] linear RGB; may be slightly negative where the spherical
//           harmonics of the light ring
void shade(const TransferLayout& layout, std::span<const float> transfer, const Albedo& albedo,
           const LightCoefficients& light, std::vector<Vec3f>& radiance);

}  // namespace paim
