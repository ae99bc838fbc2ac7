// The command line of paim-analyze.
#include "analysis/options.h"

#include <fmt/format.h>

#include <set>

#include "analysis/reference/enough_rays.h"
#include "analysis/reference/transfer_truth.h"
#include "analysis/setting_curves/group_curve.h"
#include "analysis/trade/trade_arguments.h"
#include "paim/base/error.h"
#include "paim/base/vector.h"
#include "paim/cli/light_options.h"
#include "paim/cli/parse.h"
#include "paim/sh/index.h"
#include "paim/shade/camera.h"

namespace paim {

namespace {

constexpr uint32_t kMostGroups = 32767;
constexpr uint32_t kMostCurveRays = 65536;

// Values whose form is checked after parsing.
struct RawValues {
    std::string components = "20,7,4,2";
    std::string bands = "7,4,2";
    std::string held_out;
    std::optional<std::string> curves_groups, curves_rays;
    double azimuth_deg = kDefaultAzimuth_rad * 180.0 / kPi;
    double elevation_deg = kDefaultElevation_rad * 180.0 / kPi;
    TradeArguments trade;
};

// Curves over settings that have to be measured one by one.
void add_setting_curves(CLI::App& app, AnalyzeOptions& options, RawValues& raw) {
    app.add_option(
           "--curves-of", options.curves_of,
           "A .paim made from this bake whose codec gives each vertex components of its own: "
           "measure a curve over their number (--components)")
        ->type_name("FILE");
    app.add_option(
           "--curves-groups", raw.curves_groups,
           fmt::format(
               "Numbers of {} of vertices, 1 to {}, separated by commas, such as 8,16,32,64: encode the "
               "bake with each (codec {}) and measure a curve over their number. Components are "
               "found once; of 5,000 vertices and 21 poses each number takes 1 to 3 s",
               grouped_encoder().words.numbers.front(), kMostGroups, grouped_encoder().codec))
        ->type_name("LIST");
    app.add_option(
           "--curves-rays", raw.curves_rays,
           fmt::format(
               "Rays a vertex, even, 2 to {}, separated by commas: bake the poses of --poses again "
               "with each, and with the bake's own, and measure a curve over their number. The truth "
               "has {} times the bake's rays, at most {}, which takes as many times as long as these "
               "poses took to bake",
               kMostCurveRays, kTruthRaysByRays, kMostTruthRays))
        ->type_name("LIST");
}

// What is to be measured.
void add_questions(CLI::App& app, AnalyzeOptions& options, RawValues& raw) {
    app.add_flag("--curves", options.curves,
                 "Measure curves of components and bands, which is what is done unless something "
                 "else is asked for (--curves-*, --compare, --budget, --temporal, --held-out, "
                 "--sweep)");
    add_setting_curves(app, options, raw);
    app.add_option(
           "--compare", options.compare,
           "Files (.paim) made from this bake: one table of what they take and what they err, "
           "and their pictures side by side. Without BAKE no truth is known: how unlike they are to "
           "the first file")
        ->type_name("FILE");
    app.add_option("--temporal", options.temporal,
                   "A .paim made from this bake: measure its flicker, the error of the change from "
                   "pose to pose")
        ->type_name("FILE");
    app.add_option(
           "--held-out", raw.held_out,
           "Encode every other pose to this transfer error, such as 5%, and compare the poses "
           "in between with their own bakes")
        ->type_name("ERROR");
    app.add_option(
           "--budget", options.budget,
           "A .paim made from this bake: find how much of its difference from traced pictures "
           "comes from interpolation, bands, noise, truncation and coding")
        ->type_name("FILE");
}

// How pictures are made, and what they are compared with.
void add_pictures(CLI::App& app, AnalyzeOptions& options, RawValues& raw) {
    app.add_option("--env", options.environments,
                   "Environment map (OpenEXR) of the light; may be given several times; default: "
                   "the built-in sky")
        ->allow_extra_args(false);  // one each: what follows may be the bake
    app.add_option("--components", raw.components, "Component counts to measure, besides all")
        ->capture_default_str();
    app.add_option("--bands", raw.bands,
                   "Band counts to measure, besides all; those above the bake's are left out")
        ->capture_default_str();
    cli::add_choice<ReferenceKind>(
        app, "--reference", options.reference,
        {{"bake", ReferenceKind::bake},
         {"traced", ReferenceKind::traced},
         {"traced-pixels", ReferenceKind::traced_pixels}},
        "What pictures are compared with. 'bake': all that the bake has, which shows what "
        "compression costs. 'traced': light of the whole map, traced with rays at the vertices, which "
        "shows what bands and noise cost as well. 'traced-pixels': traced at every pixel, which adds "
        "what interpolation over triangles costs");
    app.add_option(
           "--reference-rays", options.reference_rays,
           "Rays of a traced vertex or pixel, 0 to 32768, rounded up to a multiple of 4; 0 takes as "
           "many as are needed for the "
           "noise of the reference to be below a fifth of the smallest error")
        ->check(cli::in_range(0u, kMostReferenceRays))
        ->capture_default_str();
    app.add_option("--size", options.stage.size_pixels,
                   "Width and height of the images, pixels, 16 to 4096")
        ->check(cli::in_range(16, 4096))
        ->capture_default_str();
    app.add_option("--views", options.stage.num_views,
                   "Camera positions, evenly about the vertical axis, 1 to 64; the first is at "
                   "--azimuth")
        ->check(cli::in_range(1u, 64u))
        ->capture_default_str();
    app.add_option("--poses", options.stage.num_poses,
                   "Poses that are rendered, evenly spaced over the sequence, 1 to 1048576")
        ->check(cli::in_range(1u, 1u << 20))
        ->capture_default_str();
    app.add_option("--azimuth", raw.azimuth_deg,
                   "Camera angle about +Y, degrees, -360 to 360; 0 looks along -Z")
        ->check(cli::in_range(-360.0, 360.0))
        ->capture_default_str();
    app.add_option("--elevation", raw.elevation_deg,
                   "Camera angle above the horizon, degrees, -89 to 89")
        ->check(cli::in_range(-89.0, 89.0))
        ->capture_default_str();
}

// Files alone can be compared with each other.
void check_without_bake(const CLI::App& app, const AnalyzeOptions& options) {
    if (options.compare.empty()) throw_usage("BAKE is required");
    if (options.compare.size() < 2) {
        throw_usage("BAKE is required, or two files of --compare or more");
    }
    const std::set<std::string> possible{"--compare",   "--output",  "--env",   "--env-mapping",
                                         "--size",      "--views",   "--poses", "--azimuth",
                                         "--elevation", "--threads", "--json",  "--quiet"};
    for (const CLI::Option* const option : app.get_options()) {
        if (option->count() > 0 && !possible.contains(option->get_name())) {
            throw_usage("{}: needs BAKE", option->get_name());
        }
    }
}

// Error (usage) if something else than curves or files of a bake is asked of the glossy transfer.
void check_gloss(const AnalyzeOptions& options) {
    const bool others = !options.verify.empty() || options.bake_directory.empty() ||
                        options.held_out || options.trade || !options.budget.empty() ||
                        !options.temporal.empty() || !options.curves_rays.empty() ||
                        !options.curves_of.empty() || !options.curves_groups.empty() ||
                        options.reference != ReferenceKind::bake;
    if (!options.gloss || !others) return;
    throw_usage(
        "--gloss: expected --curves or --compare of a bake; other questions, and other references than the "
        "bake, are about the diffuse transfer");
}

}  // namespace

std::optional<AnalyzeOptions> parse_options(int argc, const char* const* argv, int& exit_code) {
    AnalyzeOptions options;
    RawValues raw;
    CLI::App app(
        "Measures what accuracy costs, and what is lost without it. Each question has an option:\n"
        "  --curves    how does the error fall with components and bands?\n"
        "  --budget    where does the error of a file come from, against traced light?\n"
        "  --compare   which of these files is better?\n"
        "  --target    which file looks right to 1 %, and how is it made?\n"
        "  --temporal  does a file flicker? (--held-out: what do poses between others cost?)\n"
        "  --verify    is a file as good as it says?\n"
        "Writes CSV tables, SVG charts, pictures and an index.html that shows them together.",
        "paim-analyze");
    app.set_version_flag("--version", cli::version_text("paim-analyze"));
    app.footer(
        "Errors are fractions: theory_error is the share of the singular values that is dropped "
        "(E5),\n"
        "energy_error its root-mean-square form, visual_error what is seen in rendered images "
        "(E6).\n"
        "Exit codes: 0 ok, 1 usage, 2 bad input, 3 unsupported, 4 output failed, 5 an error is "
        "larger than stated, or no file of the sweep is within the target.");
    app.add_option(
        "BAKE", options.bake_directory,
        "The .bake directory to measure; required but for --compare of two files or more");
    app.add_option("-o,--output", options.output,
                   "Directory for the results, required without --verify");
    add_questions(app, options, raw);
    add_pictures(app, options, raw);
    add_trade_options(app, raw.trade);
    CLI::Option* const verify = app.add_option(
        "--verify", options.verify,
        "A .paim made from this bake: measure its errors again and compare them with those that it "
        "states; exit code 5 if one is larger (by more than 0.000001 of it, for rounding). A note "
        "says if the file was made from another bake of this mesh");
    // All options added so far are about other measurements.
    std::vector<const CLI::Option*> not_with_verify;
    for (const CLI::Option* const option : app.get_options()) {
        const std::string name = option->get_name();
        if (name == "BAKE" || name == "--help" || name == "--version" || option == verify) continue;
        not_with_verify.push_back(option);
    }
    app.add_option("--light-spectrum", options.band_power,
                   "What errors of the transfer are weighted with: 'flat' (random light of the "
                   "bake's bands), 'natural' (real light on average) or an environment map "
                   "(OpenEXR); default: what the file's errors are of")
        ->needs(verify);
    cli::add_env_mapping(app, options.env_mapping);
    app.add_option("--threads", options.num_threads, "Threads, 0 to 1024; 0 takes every core")
        ->check(cli::in_range(0, 1024))
        ->capture_default_str();
    app.add_flag(
        "--gloss", options.gloss,
        "Measure the glossy transfer of the bake and of files, instead of the diffuse one: "
        "error curves and files side by side alone (--curves, --compare)");
    app.add_flag("--json", options.json, "Write one JSON object on stdout and nothing else");
    app.add_flag("--quiet", options.quiet, "Show no progress");
    exit_code = cli::parse(app, argc, argv);
    if (exit_code >= 0) return std::nullopt;
    for (const CLI::Option* const option : not_with_verify) {
        if (verify->count() > 0 && option->count() > 0) {
            throw_usage("--verify excludes {}", option->get_name());
        }
    }
    if (options.bake_directory.empty()) check_without_bake(app, options);
    if (options.verify.empty() && options.output.empty()) throw_usage("--output is required");
    for (const char* const name :
         {"--budget", "--curves-of", "--temporal", "--held-out", "--verify"}) {
        const CLI::Option* const option = app.get_option(name);
        if (option->count() > 0 && option->as<std::string>().empty()) {
            throw_usage("{}: expected a value, got none", name);
        }
    }
    if (!raw.held_out.empty()) options.held_out = cli::parse_share(raw.held_out, "--held-out");
    options.lists_were_given = app.count("--components") + app.count("--bands") > 0;
    options.trade = trade_options(raw.trade);
    if (raw.curves_groups) {
        options.curves_groups =
            cli::parse_list(*raw.curves_groups, "--curves-groups", 1, kMostGroups);
    }
    if (raw.curves_rays) {
        options.curves_rays =
            cli::parse_list(*raw.curves_rays, "--curves-rays", 2, kMostCurveRays, 2);
    }
    options.components = cli::parse_list(raw.components, "--components", 0, 1u << 20);
    options.bands = cli::parse_list(raw.bands, "--bands", 1, sh::kMaxBands);
    options.stage.azimuth_rad = raw.azimuth_deg * kPi / 180.0;
    options.stage.elevation_rad = raw.elevation_deg * kPi / 180.0;
    check_gloss(options);
    return options;
}

}  // namespace paim
