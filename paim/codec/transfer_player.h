// Decodes and lights coded transfer, with scratch memory that it keeps from frame to frame.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/codec/decode_limits.h"
#include "paim/light/light.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// One a thread. What it was made from has to outlive it.
class TransferPlayer {
  public:
    virtual ~TransferPlayer() = default;

    // The transfer of every vertex at `time` in poses: 0 … P−1, fractions interpolate the weights
    // linearly; clamped to that range.
    // layout    of what is decoded: bands as limited
    // transfer  [layout.num_planes()][V]
    virtual void decode(double time, const DecodeLimits& limits, TransferLayout& layout,
                        std::vector<float>& transfer) = 0;

    // What every vertex shows: albedo(v) · Σ_i t_i(v) L_i, per channel. Bands beyond the light's are
    // taken as zero. Calls with the same time and limits as the last one reuse the pose.
    // radiance  [V] linear RGB; may be slightly negative where the light rings
    virtual void light(double time, const DecodeLimits& limits, const LightCoefficients& light,
                       const Albedo& albedo, std::vector<Vec3f>& radiance) = 0;
};

}  // namespace paim
