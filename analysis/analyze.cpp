// The steps of paim-analyze.
#include "analysis/analyze.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/analysis_run.h"
#include "analysis/gnuplot.h"
#include "analysis/page.h"
#include "analysis/stable_time.h"
#include "analysis/stage.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/base/tbb_parallel.h"

namespace paim {

namespace {

// Error if the images of the report, which are kept until it is written, do not fit into memory.
void check_memory(const AnalyzeOptions& options, size_t num_images) {
    constexpr double kMaxGigabytes = 4.0;
    const double size = options.stage.size_pixels;
    const double gigabytes = 1e-9 * sizeof(Vec3f) * size * size * static_cast<double>(num_images);
    if (gigabytes > kMaxGigabytes) {
        throw_usage(
            "--size {}: {} images would take {:.1f} GB, expected at most {:g}; measure fewer "
            "settings or lights, or smaller images",
            options.stage.size_pixels, num_images, gigabytes, kMaxGigabytes);
    }
}

std::string summary_of(const BakeReader& bake, const Stage& stage) {
    return fmt::format(
        "{} vertices, {} triangles, {} poses, {} bands. Pictures are of {} of the poses, in {}.",
        bake.identity().num_vertices, bake.identity().num_triangles, bake.num_poses(),
        bake.identity().layout.in_bands, stage.poses().size(),
        stage.num_views() == 1 ? "one view" : fmt::format("{} views", stage.num_views()));
}

}  // namespace

void analyze(const AnalyzeOptions& options) {
    const ThreadLimit limit(options.num_threads);
    const BakeReader bake(options.bake_directory);
    if (is_bake(options.output)) {
        throw_usage("--output {}: is a bake, expected another directory", options.output.string());
    }
    std::vector<NamedLight> lights =
        load_lights(options.environments, options.env_mapping, bake.identity().layout.in_bands);
    const size_t most_settings = 2 * (options.components.size() + 1) + options.bands.size() + 1;
    check_memory(options, most_settings * lights.size());
    const bool with_plots = have_gnuplot();
    if (!with_plots) fmt::print(stderr, "warning: gnuplot is not installed: no SVG curves\n");
    bake.verify_all();  // before anything is written
    ensure_directory(options.output);

    const Stage stage(bake, std::move(lights), options.stage);
    const std::string name = bake.directory().stem().string();
    Page page(options.output, "Error analysis of " + name, summary_of(bake, stage));
    nlohmann::ordered_json json;
    json["directory"] = options.output.string();
    json["machine"] = machine_name();
    AnalysisRun run{options, bake, stage, with_plots, page, json};
    if (options.measures_curves()) curves_section(run);
    if (!options.compare.empty()) compare_section(run);
    if (!options.budget.empty()) budget_section(run);
    if (!options.temporal.empty()) flicker_section(run);
    if (options.held_out) held_out_section(run);
    Trade trade;
    if (options.trade) trade = trade_section(run);
    page.write();
    if (options.json) {
        fmt::print("{}\n", json_text(json, 2));
    } else {
        fmt::print("{}", recommendation_text(bake.directory(), trade));
        fmt::print("{}\n", (options.output / "index.html").string());
    }
    check_limit(trade);
}

}  // namespace paim
