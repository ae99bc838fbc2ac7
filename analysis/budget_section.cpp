// The section of the error budget.
#include "analysis/analysis_run.h"
#include "analysis/budget/budget_report.h"
#include "analysis/budget/error_budget.h"
#include "paim/base/file.h"
#include "paim/cli/progress.h"
#include "paim/format/paim/paim_read.h"

namespace paim {

void budget_section(AnalysisRun& run) {
    const std::filesystem::path& file = run.options.budget;
    const Asset asset = read_paim(file);
    const std::filesystem::path& output = run.page.directory();
    cli::Progress progress("error budget", "steps", budget_steps(run.stage), run.quiet());
    const ErrorBudget budget =
        measure_budget(run.bake, asset, run.stage, run.options.reference_rays, output,
                       [&] { progress.advance(); });
    progress.finish();
    const std::vector<NamedLight>& lights = run.stage.lights();
    write_file(output / "budget.csv", budget_csv(budget, lights));
    if (run.with_plots) write_budget_plot(output / "budget.svg", budget, lights);
    run.json["budget"] = budget_json(budget, lights);
    run.json["budget"]["file"] = file.string();
    add_budget(run.page, file.filename().string(), budget, run.stage);
}

}  // namespace paim
