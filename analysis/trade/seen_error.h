// What is seen of a file's errors, on the stage of the error curves.
#pragma once

#include "analysis/stage.h"
#include "analysis/trade/trade_point.h"

namespace paim {

// Renders each measured pose of the bake under each light now, and then those of files.
// The visual error is the largest one over the lights (E6); not a number if nothing is to be seen
// under any. Decoding is timed as the error curves do.
// bake, stage  outlive the result
PlayFile play_on_stage(const BakeReader& bake, const Stage& stage);

}  // namespace paim
