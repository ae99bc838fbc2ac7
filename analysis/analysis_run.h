// What every section of an analysis works on, and where it puts its results.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/options.h"
#include "analysis/page.h"
#include "analysis/reference/reference_kind.h"
#include "analysis/stage.h"
#include "analysis/trade/trade.h"
#include "paim/base/error.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

struct AnalysisRun {
    const AnalyzeOptions& options;
    const BakeReader& bake;  // verified
    const Stage& stage;
    const bool with_plots;
    Page& page;
    nlohmann::ordered_json& json;  // the object that --json prints
    std::optional<Reference> made_reference = {};
    std::optional<Error> unmet = {};  // what could not be measured; thrown once the page is written
    std::vector<std::string> answers = {};  // lines for people who do not open the page

    bool quiet() const { return options.quiet || options.json; }

    // What pictures are compared with; made when it is needed for the first time.
    const Reference& reference();

    // "the bake", or how many rays were traced.
    std::string reference_text();

    // On stderr, if the reference's noise under a light is large against an error.
    void say_if_noise_is_large(size_t light, double noise, double error);
};

// Measures curves of components and bands.
void curves_section(AnalysisRun& run);

// Measures a curve over the components of a vertex of a file.
void vertex_components_section(AnalysisRun& run);

// Encodes the bake with several numbers of groups of vertices, and measures them.
void groups_section(AnalysisRun& run);

// Bakes poses again with several numbers of rays, and measures them.
void rays_section(AnalysisRun& run);

// Finds where the error of a file comes from.
void budget_section(AnalysisRun& run);

// Measures the flicker of a file. The bake has at least two poses.
void flicker_section(AnalysisRun& run);

// Encodes every other pose and measures the others. The bake has at least three poses.
void held_out_section(AnalysisRun& run);

// Measures what accuracy costs, and finds what to run for a limit (check_limit()).
Trade trade_section(AnalysisRun& run);

// Measures several files and shows them side by side.
void compare_section(AnalysisRun& run);

}  // namespace paim
