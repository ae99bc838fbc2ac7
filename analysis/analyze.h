// The steps of paim-analyze.
#pragma once

#include "analysis/options.h"

namespace paim {

// Measures, writes and reports. Throws Error.
void analyze(const AnalyzeOptions& options);

}  // namespace paim
