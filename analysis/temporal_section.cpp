// The sections of flicker and held-out poses.
#include <fmt/format.h>

#include "analysis/analysis_run.h"
#include "analysis/temporal/temporal_report.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/cli/progress.h"
#include "paim/format/paim/paim_read.h"

namespace paim {

void flicker_section(AnalysisRun& run) {
    const std::filesystem::path& file = run.options.temporal;
    const Asset asset = read_paim(file);
    FilePoses poses(asset, run.bake);
    cli::Progress progress("flicker", "poses", run.bake.num_poses(), run.quiet());
    const std::vector<Flicker> flickers =
        measure_flicker(run.bake, poses, run.stage, [&] { progress.advance(); });
    progress.finish();
    const std::vector<NamedLight>& lights = run.stage.lights();
    const std::filesystem::path& output = run.page.directory();
    write_file(output / "flicker.csv", flicker_csv(flickers, lights));
    if (run.with_plots) write_flicker_plot(output / "flicker.svg", flickers, lights);
    run.json["flicker"] = {{"file", file.string()}, {"lights", flicker_json(flickers, lights)}};
    for (size_t light = 0; light < lights.size(); ++light) {
        run.answers.push_back(fmt::format(
            "flicker of {} under {}: {} of the change from pose to pose, {} of the radiance",
            file.filename().string(), lights[light].name, percent_text(flickers[light].of_change()),
            percent_text(flickers[light].of_radiance())));
    }
    add_flicker(run.page, file.filename().string(), flickers, lights);
}

void held_out_section(AnalysisRun& run) {
    const std::filesystem::path& output = run.page.directory();
    cli::Progress progress("held-out poses", "poses", (run.bake.num_poses() - 1) / 2, run.quiet());
    HeldOut held_out;
    try {
        held_out = measure_held_out(run.bake, run.stage, *run.options.held_out, output,
                                    [&] { progress.advance(); });
    } catch (const Error& error) {
        if (error.code() != ExitCode::threshold_exceeded) throw;
        // What else was measured is not lost.
        run.unmet =
            Error(error.code(), fmt::format("--held-out: of every other pose, {}", error.what()));
        return;
    }
    progress.finish();
    const std::vector<NamedLight>& lights = run.stage.lights();
    write_file(output / "held_out.csv", held_out_csv(held_out, lights));
    run.json["held_out"] = held_out_json(held_out, lights);
    for (size_t light = 0; light < lights.size(); ++light) {
        run.answers.push_back(fmt::format(
            "poses between encoded ones under {}: seen {} decoded, {} interpolated from the bake",
            lights[light].name, percent_text(held_out.encoded.seen[light].visual_error()),
            percent_text(held_out.interpolated.seen[light].visual_error())));
    }
    add_held_out(run.page, held_out, lights);
}

}  // namespace paim
