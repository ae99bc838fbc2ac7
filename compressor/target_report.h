// The report of paim-compress about a file that meets a target, as text and as JSON.
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

// Lines, each with a line feed: the candidates, which of them was chosen, and the measured errors.
std::string report_text(const TargetReport& report);

// The same of glossy transfer, whose positions are those of the diffuse file.
std::string gloss_text(const TargetReport& report);

}  // namespace paim
