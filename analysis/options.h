// The command line of paim-analyze.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/trade/trade.h"
#include "paim/light/env_mapping.h"

namespace paim {

struct AnalyzeOptions {
    std::filesystem::path bake_directory;
    std::filesystem::path output;
    std::filesystem::path verify;                     // a .paim to check instead; empty: none
    std::string band_power;                           // for --verify; empty: that of the file
    std::vector<std::filesystem::path> environments;  // none: the built-in sky
    EnvMapping env_mapping = EnvMapping::automatic;   // of all maps
    std::vector<uint32_t> components{20, 7, 4, 2};    // in addition to all
    std::vector<uint32_t> bands{7, 4, 2};             // in addition to all
    int size_pixels = 256;
    uint32_t num_poses = 4;
    double azimuth_rad = 0.0;
    double elevation_rad = 0.0;
    std::optional<TradeOptions> trade;  // a sweep, if one is asked for
    int num_threads = 0;
    bool json = false;
    bool quiet = false;
};

// Parses the command line. Returns nothing when the tool is done, with the exit code in exit_code.
// Throws Error(usage) for values out of range.
std::optional<AnalyzeOptions> parse_options(int argc, const char* const* argv, int& exit_code);

}  // namespace paim
