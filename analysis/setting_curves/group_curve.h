// Error curve over the number of groups of vertices that share values.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "analysis/reference/reference_kind.h"
#include "analysis/setting_curves/setting_curve.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// The first codec whose number of groups can be chosen (TransferEncoderType::code_groups). There is one.
const TransferEncoderType& grouped_encoder();

// Encodes the bake with each number of groups, from one factorisation, and measures what the files take and
// how their transfer errs. Positions of the files err by what cannot be seen (kInvisibleMotion).
// wanted   above 0; numbers that there are not vertices enough for become the largest that there are for
// scratch  directory for a file at a time
// notes    receives one for each such number
// on_step  called after each file, and after each file of each pose
SettingCurve measure_groups(const BakeReader& bake, const Stage& stage, const Reference& reference,
                            const std::vector<uint32_t>& wanted,
                            const std::filesystem::path& scratch, std::vector<std::string>& notes,
                            const std::function<void()>& on_step);

}  // namespace paim
