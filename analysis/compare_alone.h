// Files side by side without their bake.
#pragma once

#include "analysis/options.h"

namespace paim {

// Measures, writes and reports. Throws Error.
void compare_alone(const AnalyzeOptions& options);

}  // namespace paim
