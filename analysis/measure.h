// Measures error curves: every setting decoded, rendered and compared with a reference.
#pragma once

#include <functional>
#include <vector>

#include "analysis/curves.h"
#include "analysis/reference/reference_pictures.h"
#include "analysis/stage.h"

namespace paim {

// What was compared with.
struct MeasuredReference {
    std::vector<Image> images;  // [lights] of the first measured pose in the first view
    std::vector<double> noise;  // [lights] of all pictures, relative (RelativeNoise)
};

// Adds the transfer of a decoded pose. Planes that it does not have count as zero.
void add_transfer(ArrayError& error, const DecodedPose& decoded, const DecodedPose& baked,
                  uint32_t p);

// Fills in what plan_curves() left to be measured, but for times. One pose is in memory at a time.
// on_step  called after each setting of each pose, num_points · stage.poses().size() times
MeasuredReference measure_curves(const BakeReader& bake, const Asset& asset, const Stage& stage,
                                 const ReferenceSource& reference, std::vector<Curve>& curves,
                                 const std::function<void()>& on_step);

// Fills in how long decoding takes.
// on_step  called after each setting, num_points times
void time_curves(const Asset& asset, std::vector<Curve>& curves,
                 const std::function<void()>& on_step);

}  // namespace paim
