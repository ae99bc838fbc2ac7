// What only playing a file shows: its visual error, and the time of a frame.
#pragma once

#include <vector>

#include "analysis/reference/reference_pictures.h"
#include "analysis/stage.h"
#include "analysis/trade/trade_point.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Makes the pictures of the reference now, and then those of files. The visual error is the largest one
// over the lights (E6); not a number if nothing is to be seen under any.
// bake, stage  outlive the result
// noise        [lights] receives that of the reference, relative
PlayFile play_on_stage(const BakeReader& bake, const Stage& stage, const ReferenceSource& reference,
                       std::vector<double>& noise);

}  // namespace paim
