// The section of files side by side.
#include "analysis/analysis_run.h"
#include "analysis/compare/compare_report.h"
#include "paim/base/file.h"
#include "paim/cli/progress.h"

namespace paim {

void compare_section(AnalysisRun& run) {
    const std::vector<std::filesystem::path>& paths = run.options.compare;
    const Reference& reference = run.reference();
    cli::Progress progress("comparing", "steps", compare_steps(paths.size(), run.bake, run.stage),
                           run.quiet());
    const FileComparison comparison =
        compare_files(paths, run.bake, run.stage, reference.source, [&] { progress.advance(); });
    progress.finish();
    const std::vector<NamedLight>& lights = run.stage.lights();
    write_file(run.page.directory() / "compare.csv", compare_csv(comparison, lights));
    run.json["compare"] = compare_json(comparison, lights);
    add_comparison(run.page, comparison, run.stage, reference.name);
}

}  // namespace paim
