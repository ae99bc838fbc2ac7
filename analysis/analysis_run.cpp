// What every section of an analysis works on.
#include "analysis/analysis_run.h"

#include <fmt/format.h>

namespace paim {

const Reference& AnalysisRun::reference() {
    if (!made_reference) {
        made_reference = make_reference(options.reference, options.reference_rays, bake, stage);
    }
    return *made_reference;
}

std::string AnalysisRun::reference_text() {
    const Reference& chosen = reference();
    if (!chosen.traced) return chosen.name;
    return fmt::format("light that was {} by up to {} rays", chosen.name,
                       chosen.traced->most_rays());
}

void AnalysisRun::say_if_noise_is_large(size_t light, double noise, double error) {
    const std::string note = noise_note(reference(), stage, light, noise, error);
    if (!note.empty()) fmt::print(stderr, "paim-analyze: note: {}\n", note);
}

}  // namespace paim
