// The sections of curves over components of a vertex, groups of vertices, and rays.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/analysis_run.h"
#include "analysis/bake_file.h"
#include "analysis/setting_curves/group_curve.h"
#include "analysis/setting_curves/ray_curve.h"
#include "analysis/setting_curves/setting_curve_report.h"
#include "analysis/setting_curves/vertex_component_curve.h"
#include "paim/base/file.h"
#include "paim/cli/progress.h"

namespace paim {

namespace {

// On stderr, where the noise of the run's reference disturbs.
void say_where_noise_is_large(AnalysisRun& run, const SettingCurve& curve) {
    for (size_t light = 0; light < run.stage.lights().size(); ++light) {
        double smallest = std::numeric_limits<double>::infinity();
        for (const Setting& setting : curve.settings) {
            smallest = std::min(smallest, setting.seen[light].visual_error());
        }
        run.say_if_noise_is_large(light, curve.noise[light], smallest);
    }
}

void report(AnalysisRun& run, const SettingCurve& curve) {
    const std::vector<NamedLight>& lights = run.stage.lights();
    const std::filesystem::path& output = run.page.directory();
    write_file(output / (curve.name + ".csv"), setting_curve_csv(curve, lights));
    if (run.with_plots) write_setting_plot(output, curve, lights);
    run.json[curve.name] = setting_curve_json(curve, lights);
    add_setting_curve(run.page, curve, run.stage);
}

// On stderr, for each number that is more than there is.
void say_what_is_too_much(const std::vector<uint32_t>& wanted, const std::string& name,
                          uint32_t all) {
    for (const uint32_t value : wanted) {
        if (value <= all) continue;
        fmt::print(stderr, "paim-analyze: note: {}: {} asked for, there are {}\n", name, value,
                   all);
    }
}

}  // namespace

void vertex_components_section(AnalysisRun& run) {
    const Asset asset = read_file_of(run.bake, run.options.curves_of);
    const TransferModel& transfer = *asset.moving().transfer;
    const uint32_t all = transfer.num_vertex_components();
    const std::vector<uint32_t>& wanted = run.options.components;
    if (run.options.lists_were_given) {
        say_what_is_too_much(wanted, vertex_component_name(transfer), all);
    }
    cli::Progress progress("components of a vertex", "pictures",
                           values_up_to(all, wanted).size() * run.stage.poses().size(),
                           run.quiet());
    const SettingCurve curve = measure_vertex_components(
        asset, run.bake, run.stage, run.reference(), wanted, [&] { progress.advance(); });
    progress.finish();
    say_where_noise_is_large(run, curve);
    report(run, curve);
}

void groups_section(AnalysisRun& run) {
    const std::vector<uint32_t>& wanted = run.options.curves_groups;
    std::vector<std::string> notes;
    cli::Progress progress("groups", "steps", wanted.size() * (1 + run.stage.poses().size()),
                           run.quiet());
    const SettingCurve curve =
        measure_groups(run.bake, run.stage, run.reference(), wanted, run.page.directory(), notes,
                       [&] { progress.advance(); });
    progress.finish();
    for (const std::string& note : notes) fmt::print(stderr, "paim-analyze: note: {}\n", note);
    say_where_noise_is_large(run, curve);
    report(run, curve);
}

void rays_section(AnalysisRun& run) {
    const std::vector<uint32_t>& wanted = run.options.curves_rays;
    say_what_is_too_much(wanted, "rays", run.bake.identity().rays);
    cli::Progress progress("rays", "pictures", ray_curve_steps(run.bake, run.stage, wanted),
                           run.quiet());
    const SettingCurve curve =
        measure_rays(run.bake, run.stage, wanted, [&] { progress.advance(); });
    progress.finish();
    report(run, curve);
}

}  // namespace paim
