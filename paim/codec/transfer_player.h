// Decodes and lights coded transfer, with scratch memory that it keeps from frame to frame.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/codec/decode_limits.h"
#include "paim/light/light.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// Used by one thread at a time. The model that it was made from must outlive it.
class TransferPlayer {
  public:
    virtual ~TransferPlayer() = default;

    // The transfer of all vertices at `time` in poses, clamped to 0 … P−1. At fractions weights are
    // interpolated linearly.
    // layout    of the result: with the bands within the limits
    // transfer  [layout.num_planes()][V]
    virtual void decode(double time, const DecodeLimits& limits, TransferLayout& layout,
                        std::vector<float>& transfer) = 0;

    // The radiance of all vertices, albedo(v) · Σ_i t_oi(v) L_i per channel, for each outgoing
    // coefficient o. Bands that the light does not have are zero. A call with the same time and
    // limits as the last one reuses the pose.
    // radiance  [num_outgoing][V] linear RGB; may be slightly negative where the spherical
    //           harmonics of the light ring
    virtual void light(double time, const DecodeLimits& limits, const LightCoefficients& light,
                       const Albedo& albedo, std::vector<Vec3f>& radiance) = 0;
};

}  // namespace paim
