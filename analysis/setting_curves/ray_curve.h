// Error curve over the rays of a bake.
#pragma once

#include <functional>
#include <vector>

#include "analysis/setting_curves/setting_curve.h"
#include "compressor/bake/bake_options.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// The noise that is expected of a bake of this sampler with other rays: it falls as a power of the rays
// (error_power()).
// noise  of a bake with from_rays, relative
double expected_noise(double noise, uint32_t from_rays, uint32_t rays, SamplerKind sampler);

// Bakes the poses of the stage again in memory: once with many rays, the truth (TransferTruth), and with
// the bake's rays and each smaller number that is wanted. Pictures under the truth are the reference. Columns
// are the noise that is expected by the power law from that of the most rays, the noise that each bake states,
// and the error to the truth.
// wanted   even; larger ones than the bake's are left out
// on_step  called ray_curve_steps() times
SettingCurve measure_rays(const BakeReader& bake, const Stage& stage,
                          const std::vector<uint32_t>& wanted,
                          const std::function<void()>& on_step);
size_t ray_curve_steps(const BakeReader& bake, const Stage& stage,
                       const std::vector<uint32_t>& wanted);

}  // namespace paim
