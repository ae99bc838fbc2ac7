// The section of files side by side.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

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
    for (size_t light = 0; light < lights.size(); ++light) {
        double smallest = std::numeric_limits<double>::infinity();
        for (const ComparedFile& file : comparison.files) {
            smallest = std::min(smallest, file.seen[light].visual_error());
        }
        run.say_if_noise_is_large(light, comparison.reference_noise[light], smallest);
    }
    write_file(run.page.directory() / "compare.csv", compare_csv(comparison, lights));
    run.json["compare"] = compare_json(comparison, lights);
    for (const ComparedFile& file : comparison.files) {
        std::string line =
            fmt::format("{}: {} bytes", file.path.filename().string(), file.size_bytes);
        for (size_t light = 0; light < lights.size(); ++light) {
            line += fmt::format(", seen {} under {}", percent_text(file.seen[light].visual_error()),
                                lights[light].name);
        }
        run.answers.push_back(line + ", against " + run.reference_text());
    }
    add_comparison(run.page, comparison, run.stage, reference.name);
}

}  // namespace paim
