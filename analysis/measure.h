// Measures error curves: every setting decoded, rendered and compared with the bake.
#pragma once

#include <functional>
#include <vector>

#include "analysis/curves.h"
#include "analysis/stage.h"

namespace paim {

// Fills in what plan_curves() left to be measured. One pose is in memory at a time.
// on_step  called after each setting of each pose, num_points · stage.poses().size() times
// returns  [lights] the images of the bake itself in the first measured pose
std::vector<Image> measure_curves(const BakeReader& bake, const Asset& asset, const Stage& stage,
                                  std::vector<Curve>& curves, const std::function<void()>& on_step);

}  // namespace paim
