// What paim-compress says of a file that was made to meet a target.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "compressor/encode/search/target_encode.h"

namespace paim {

nlohmann::ordered_json target_json(const TargetSummary& summary);

// Lines, each ended: what was compared, what was chosen and why, and what was measured.
std::string target_text(const std::string& file, const TargetSummary& summary);

}  // namespace paim
