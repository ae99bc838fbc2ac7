// How long a frame of an asset takes on the CPU.
#pragma once

#include <memory>

#include "analysis/stable_time.h"
#include "paim/codec/asset.h"
#include "paim/light/light.h"

namespace paim {

// Positions, radiance and outgoing coefficients of gloss of a frame by Playback.
// most_seconds  as of time_poses()
PoseTime time_frames(const std::shared_ptr<const Asset>& asset, const LightCoefficients& light,
                     double most_seconds);

}  // namespace paim
