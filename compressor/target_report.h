// What paim-compress says of a file that meets a target, to people and to programs.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "compressor/encode/search/target_encode.h"

namespace paim {

struct TargetReport {
    std::filesystem::path paim;
    TargetSummary summary;
};

nlohmann::ordered_json report_json(const TargetReport& report);

// Lines, each ended: the candidates, which of them was chosen, and the errors that were measured.
std::string report_text(const TargetReport& report);

}  // namespace paim
