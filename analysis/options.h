// The command line of paim-analyze.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/reference/reference_kind.h"
#include "analysis/stage.h"
#include "analysis/trade/trade.h"
#include "paim/light/env_mapping.h"

namespace paim {

struct AnalyzeOptions {
    std::filesystem::path bake_directory;  // empty: files of `compare` alone
    std::filesystem::path output;
    bool gloss = false;                          // of the glossy transfer, not the diffuse one
    std::filesystem::path verify;                // a .paim to check instead; empty: none
    std::string band_power;                      // for --verify; empty: that of the file
    bool curves = false;                         // asked for by name
    std::filesystem::path curves_of;             // a .paim with components of vertices; empty: none
    std::vector<uint32_t> curves_groups;         // numbers of groups to encode with; none: no curve
    std::vector<uint32_t> curves_rays;           // rays to bake with; none: no curve
    std::vector<std::filesystem::path> compare;  // .paim files side by side
    std::filesystem::path temporal;              // a .paim whose flicker is measured; empty: none
    std::optional<double> held_out;              // error that every other pose is encoded to
    std::filesystem::path budget;                // a .paim whose error is taken apart; empty: none
    std::vector<std::filesystem::path> environments;  // none: the built-in sky
    EnvMapping env_mapping = EnvMapping::automatic;   // of all maps
    std::vector<uint32_t> components{20, 7, 4, 2};    // in addition to all
    std::vector<uint32_t> bands{7, 4, 2};             // in addition to all
    bool lists_were_given = false;                    // one of these two, by a person
    ReferenceKind reference = ReferenceKind::bake;
    uint32_t reference_rays = 0;  // 0: as many as are needed
    StageOptions stage;
    std::optional<TradeOptions> trade;  // a sweep, if one is asked for
    int num_threads = 0;
    bool json = false;
    bool quiet = false;

    bool measures_setting_curves() const {
        return !curves_of.empty() || !curves_groups.empty() || !curves_rays.empty();
    }
    // Unless something else alone was asked for.
    bool measures_curves() const {
        return curves || (budget.empty() && compare.empty() && temporal.empty() && !held_out &&
                          !trade && !measures_setting_curves());
    }
};

// Parses the command line. Returns nothing when the tool is done, with the exit code in exit_code.
// Throws Error(usage) for values out of range.
std::optional<AnalyzeOptions> parse_options(int argc, const char* const* argv, int& exit_code);

}  // namespace paim
