// The steps of paim-compress.
#pragma once

#include "compressor/options.h"

namespace paim {

// Runs the command and reports on stdout: text, or one JSON object. Throws Error.
void run(const CompressOptions& options);

}  // namespace paim
