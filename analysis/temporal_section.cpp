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
    if (run.bake.num_poses() < 2) {
        throw_bad_input("--temporal: {} has one pose, expected at least 2",
                        run.bake.directory().string());
    }
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
    add_flicker(run.page, file.filename().string(), flickers, lights);
}

void held_out_section(AnalysisRun& run) {
    if (run.bake.num_poses() < 3) {
        throw_bad_input("--held-out: {} has {} poses, expected at least 3",
                        run.bake.directory().string(), run.bake.num_poses());
    }
    const std::filesystem::path& output = run.page.directory();
    cli::Progress progress("held-out poses", "poses", (run.bake.num_poses() - 1) / 2, run.quiet());
    const HeldOut held_out = measure_held_out(run.bake, run.stage, *run.options.held_out, output,
                                              [&] { progress.advance(); });
    progress.finish();
    const std::vector<NamedLight>& lights = run.stage.lights();
    write_file(output / "held_out.csv", held_out_csv(held_out, lights));
    run.json["held_out"] = held_out_json(held_out, lights);
    add_held_out(run.page, held_out, lights);
}

}  // namespace paim
