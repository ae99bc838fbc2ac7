// What paim-compress says of an encoding, to people and to programs.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "compressor/encode/encode.h"

namespace paim {

nlohmann::ordered_json encode_json(const EncodeSummary& summary);

// Lines, each ended.
std::string encode_text(const std::string& file, const EncodeSummary& summary);

// Whether most of the error that is expected is the bake's noise, so that more rays would help more than
// more components.
bool more_rays_would_help(const EncodeSummary& summary);

}  // namespace paim
