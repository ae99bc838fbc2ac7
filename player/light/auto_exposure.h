// The exposure that suits what is lit, or the light alone.
#pragma once

#include <span>

#include "paim/light/light.h"

namespace paim::player {

constexpr float kLargestExposure_ev = 30.0f;

// The exposure in stops at which 98 % of the vertices that are not black have no channel above 1, the
// white of ToneOperator::clamp (suggested_exposure_ev()). From −30 to 30; 0 where all is black.
// Values that are not finite do not count. Of many vertices every n-th is looked at, so that a part
// of any size takes a millisecond.
// parts  linear radiance of the vertices of each part (Playback::radiance())
float auto_exposure_ev(std::span<const std::span<const Vec3f>> parts);

// The same of open white surfaces that face all directions under the light, for a scene whose
// vertices are not known.
float auto_exposure_ev(const LightCoefficients& light);

}  // namespace paim::player
