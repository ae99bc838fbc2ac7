// The steps of paim-analyze.
#pragma once

#include <cstddef>

#include "analysis/options.h"

namespace paim {

// Error (usage): the pictures of so many lights that are held at once do not fit into memory.
void check_picture_memory(const AnalyzeOptions& options, size_t num_lights);

// Measures, writes and reports. Throws Error.
void analyze(const AnalyzeOptions& options);

}  // namespace paim
