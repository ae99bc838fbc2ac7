// Poses that a file was made without, against their own bakes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "analysis/picture_errors.h"
#include "analysis/stage.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/array_error.h"

namespace paim {

// Errors of in-between poses.
struct InBetweenError {
    std::vector<PictureErrors> seen;  // [lights]
    DistanceError distance;           // scene units
    ArrayError transfer;
};

struct HeldOut {
    double target = 0.0;        // error of the encoded half
    uint32_t num_kept = 0;      // poses that were encoded: 0, 2, 4 …
    uint32_t num_measured = 0;  // poses between two of them
    InBetweenError encoded;     // of the file
    // Of poses that are baked themselves, noise included, and interpolated without encoding.
    InBetweenError interpolated;
};

// Encodes every other pose to a transfer error and measures the poses in between. Pictures are of as
// many of these as the stage has poses.
// bake       with at least 3 poses (checked)
// target     of encode_to_target(), with its default options
// directory  for a temporary bake of half the poses
// on_pose    called after each pose that is measured, bake.num_poses() / 2 times or once less
// Errors: those of encode_to_target().
HeldOut measure_held_out(const BakeReader& bake, const Stage& stage, double target,
                         const std::filesystem::path& directory,
                         const std::function<void()>& on_pose);

}  // namespace paim
