// paim-study: the measurements behind the defaults.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include <algorithm>

#include "analysis/study/open_source.h"
#include "analysis/study/studies.h"
#include "paim/base/error.h"
#include "paim/cli/parse.h"
#include "paim/cli/run_main.h"
#include "paim/sh/index.h"

namespace {

using namespace paim;

void check_even(const char* option, uint32_t rays) {
    if (rays % 2 != 0) {
        throw_usage("{}: expected an even number (two halves), got {}", option, rays);
    }
}

int run(int argc, char** argv) {
    CLI::App app(
        "Measures what bakes cost and how true they are; writes CSV on stdout.\n\n"
        "  noise     encoded transfer: rays, random streams, components, shrinkage\n"
        "  samplers  the bake itself: rays and samplers\n"
        "  targets   error targets against fixed counts of rays\n",
        "paim-study");
    std::string study;
    std::vector<std::string> inputs;
    study::StudyOptions options;
    uint32_t num_vertices = 6000;
    options.num_poses = 24;
    options.rays = {64, 256, 1024};
    options.targets = {0.1, 0.05, 0.02, 0.01};
    app.add_option("STUDY", study, "noise, samplers or targets")
        ->required()
        ->check(CLI::IsMember({"noise", "samplers", "targets"}));
    app.add_option("OBJ", inputs, study::kInputsHelp)->required();
    app.add_option("--name", options.name, "Name in the CSV; default: the first input");
    const auto rays_range = cli::in_range(uint32_t{2}, uint32_t{1} << 24);
    app.add_option("--poses", options.num_poses, "The first so many poses, 1 to 10000")
        ->check(cli::in_range(uint32_t{1}, uint32_t{10'000}))
        ->capture_default_str();
    app.add_option("--vertices", num_vertices, "Of the octopus or the bowl")->capture_default_str();
    app.add_option("--bands", options.bands, fmt::format("Bands, 1 to {}", sh::kMaxBands))
        ->check(cli::in_range(1, static_cast<int>(sh::kMaxBands)))
        ->capture_default_str();
    app.add_option("--truth-rays", options.truth_rays,
                   "Rays of what counts as true (seed 77), even, 2 to 16777216")
        ->check(rays_range)
        ->capture_default_str();
    app.add_option("--rays", options.rays, "Rays to try (seed 1), even, 2 to 16777216")
        ->delimiter(',')
        ->check(rays_range);
    app.add_option("--targets", options.targets, "Error targets to try, 0.000001 to 1")
        ->delimiter(',')
        ->check(cli::in_range(1e-6, 1.0));
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;
    check_even("--truth-rays", options.truth_rays);
    for (const uint32_t rays : options.rays) check_even("--rays", rays);
    if (options.name.empty()) options.name = inputs.front();
    const auto source = study::open_source(inputs, num_vertices, options.num_poses);
    options.num_poses = std::min(options.num_poses, source->num_poses());
    if (study == "noise") study_noise(*source, options);
    if (study == "samplers") study_samplers(*source, options);
    if (study == "targets") study_targets(*source, options);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return paim::cli::run_main("paim-study", [&] { return run(argc, argv); });
}
