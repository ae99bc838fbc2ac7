// The report of paim-compress about an encoding, as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "compressor/encode/encode.h"

namespace paim {

struct EncodeReport {
    std::filesystem::path paim;
    uint32_t num_vertices = 0, num_poses = 0;
    EncodeSummary summary;

    // Whether most of the expected error is the noise of the bake, so that more rays would help
    // more than more components.
    bool more_rays_would_help() const;
};

nlohmann::ordered_json report_json(const EncodeReport& report);

// Lines, each with a line feed.
std::string report_text(const EncodeReport& report);
inline std::string gloss_text(const EncodeReport& report) {
    return report_text(report);
}

// The numbers of named_errors(), by name.
nlohmann::ordered_json errors_json(const AssetError& error);

}  // namespace paim
