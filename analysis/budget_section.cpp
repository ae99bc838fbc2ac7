// The section of the error budget.
#include <fmt/format.h>

#include <algorithm>

#include "analysis/analysis_run.h"
#include "analysis/budget/budget_report.h"
#include "analysis/budget/error_budget.h"
#include "analysis/reference/enough_rays.h"
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
    for (size_t light = 0; light < lights.size(); ++light) {
        // Terms that traced pictures are part of.
        const double noise = std::max(budget.pixel_noise[light], budget.vertex_noise[light]);
        for (size_t n = 0; n < 2; ++n) {
            const BudgetTerm& term = budget.terms[n];
            const double error = term.errors[light].visual_error();
            if (!(noise > kNoiseOfError * error)) continue;
            fmt::print(
                stderr,
                "paim-analyze: note: light {}: {} is {:.2g} %, of which a part is the noise of "
                "traced pictures, {:.2g} %; more --reference-rays make it smaller\n",
                lights[light].name, term.name, 100.0 * error, 100.0 * noise);
        }
    }
    run.answers.push_back(budget_answer(file.filename().string(), budget, lights));
    add_budget(run.page, file.filename().string(), budget, run.stage);
}

}  // namespace paim
