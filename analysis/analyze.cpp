// The steps of paim-analyze.
#include "analysis/analyze.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "analysis/analysis_run.h"
#include "analysis/bake_file.h"
#include "analysis/gnuplot.h"
#include "analysis/page.h"
#include "analysis/same_bake.h"
#include "analysis/setting_curves/vertex_component_curve.h"
#include "analysis/stable_time.h"
#include "analysis/stage.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "paim/base/tbb_parallel.h"
#include "paim/metrics/asset_error.h"

namespace paim {

namespace {

// How many pictures are held at once, at most: those that the page shows, of the first pose and view, and
// all of a pose in some lists. A sweep keeps those of all poses of its reference.
size_t num_pictures_held(const AnalyzeOptions& options, size_t num_lights) {
    constexpr size_t kListsOfAPose = 6, kPicturesOfABudget = 20;
    const size_t of_pose = size_t{options.stage.num_views} * num_lights;
    const size_t settings = 2 * (options.components.size() + 1) + options.bands.size() + 1;
    size_t shown = 0;
    if (options.measures_curves()) shown = std::max(shown, settings);
    if (!options.curves_of.empty()) shown = std::max(shown, options.components.size() + 1);
    shown = std::max({shown, options.curves_groups.size(), options.curves_rays.size() + 1});
    if (!options.budget.empty()) shown = std::max(shown, kPicturesOfABudget);
    shown = std::max(shown, 3 * options.compare.size());
    const size_t kept = options.trade ? size_t{options.stage.num_poses} * of_pose : 0;
    return shown * num_lights + kListsOfAPose * of_pose + kept;
}

// Before anything is measured: that files can be read and are of this bake, and that there are poses
// enough.
void check_inputs(const AnalyzeOptions& options, const BakeReader& bake) {
    std::vector<std::filesystem::path> files = options.compare;
    for (const auto& file : {options.budget, options.curves_of, options.temporal}) {
        if (!file.empty()) files.push_back(file);
    }
    bool has_gloss = false;  // in addition to the transfer that is measured
    for (const std::filesystem::path& file : files) {
        const Asset asset = read_file_of(bake, file);
        try {
            for (size_t part = 0; part < asset.parts.size(); ++part) match_part(asset, part, bake);
            if (file == options.curves_of) vertex_component_name(*asset.moving().transfer);
        } catch (const Error& error) {
            throw Error(error.code(), fmt::format("{}: {}", file.string(), error.what()));
        }
        say_if_of_another_bake("paim-analyze", file, asset, bake);
        has_gloss = has_gloss || asset.moving().gloss.has_value();
    }
    if (has_gloss && !options.compare.empty()) {
        fmt::print(
            stderr,
            "paim-analyze: note: --compare does not compare gloss, which counts in sizes and times "
            "alone; --gloss --compare compares gloss alone\n");
    }
    const auto need_poses = [&](const char* option, uint32_t least) {
        if (bake.num_poses() >= least) return;
        throw_bad_input("{}: {} has {} pose{}, expected at least {}", option,
                        bake.directory().string(), bake.num_poses(),
                        bake.num_poses() == 1 ? "" : "s", least);
    };
    if (!options.temporal.empty()) need_poses("--temporal", 2);
    if (options.held_out) need_poses("--held-out", 3);
}

// On stderr, for options that change nothing here.
void say_what_is_not_used(const AnalyzeOptions& options) {
    const bool compares = options.measures_curves() || !options.curves_of.empty() ||
                          !options.curves_groups.empty() || !options.compare.empty() ||
                          options.trade;
    const bool traces = options.reference != ReferenceKind::bake && compares;
    const auto say = [](const char* option, const char* where) {
        fmt::print(stderr, "paim-analyze: note: {} is not used: it is for {}\n", option, where);
    };
    if (options.lists_were_given && !options.measures_curves() && options.curves_of.empty()) {
        say("--components or --bands", "--curves and --curves-of");
    }
    if (options.reference != ReferenceKind::bake && !compares) {
        say("--reference", "--curves, --curves-of, --curves-groups, --compare and --sweep");
    }
    if (options.reference_rays > 0 && !traces && options.budget.empty()) {
        say("--reference-rays", "--reference traced or traced-pixels, and --budget");
    }
}

std::string summary_of(const BakeReader& bake, const Stage& stage) {
    return fmt::format(
        "{} vertices, {} triangles, {} poses, {} bands. Pictures are of {} of the poses, in {}.",
        bake.identity().num_vertices, bake.identity().num_triangles, bake.num_poses(),
        bake.identity().layout.in_bands, stage.poses().size(), stage.views_text());
}

}  // namespace

void check_picture_memory(const AnalyzeOptions& options, size_t num_lights) {
    constexpr double kMaxGigabytes = 4.0;
    const size_t num_images = num_pictures_held(options, num_lights);
    const double size = options.stage.size_pixels;
    const double gigabytes = 1e-9 * sizeof(Vec3f) * size * size * static_cast<double>(num_images);
    if (gigabytes > kMaxGigabytes) {
        throw_usage(
            "--size {}: {} images would take {:.1f} GB, expected at most {:g}; measure fewer "
            "settings, lights, views or poses, or smaller images",
            options.stage.size_pixels, num_images, gigabytes, kMaxGigabytes);
    }
}

void analyze(const AnalyzeOptions& options) {
    const ThreadLimit limit(options.num_threads);
    const BakeReader bake = options.gloss ? BakeReader(options.bake_directory).gloss()
                                          : BakeReader(options.bake_directory);
    if (is_bake(options.output)) {
        throw_usage("--output {}: is a bake, expected another directory", options.output.string());
    }
    std::vector<NamedLight> lights =
        load_lights(options.environments, options.env_mapping, bake.identity().layout.in_bands);
    check_picture_memory(options, lights.size());
    say_what_is_not_used(options);
    const bool with_plots = have_gnuplot();
    if (!with_plots) fmt::print(stderr, "warning: gnuplot is not installed: no SVG curves\n");
    bake.verify_all();  // before anything is written
    check_inputs(options, bake);
    ensure_directory(options.output);

    const Stage stage(bake, std::move(lights), options.stage);
    const std::string name = bake.directory().stem().string();
    Page page(options.output, "Error analysis of " + name, summary_of(bake, stage));
    nlohmann::ordered_json json;
    json["directory"] = options.output.string();
    json["machine"] = machine_name();
    AnalysisRun run{options, bake, stage, with_plots, page, json};
    if (options.measures_curves()) curves_section(run);
    if (!options.curves_of.empty()) vertex_components_section(run);
    if (!options.curves_groups.empty()) groups_section(run);
    if (!options.curves_rays.empty()) rays_section(run);
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
        for (const std::string& answer : run.answers) fmt::print("{}\n", answer);
        fmt::print("{}", recommendation_text(bake.directory(), trade));
        fmt::print("{}\n", (options.output / "index.html").string());
    }
    check_limit(trade);
    if (run.unmet) throw *run.unmet;
}

}  // namespace paim
