// Checks that a .paim is within the errors that it states.
#pragma once

#include "analysis/options.h"

namespace paim {

// Measures options.verify against the bake and prints the errors measured and stated, as text or
// JSON.
// Errors: threshold exceeded, naming the first error that is larger than stated; bad input if the
// file states none or is not of this bake; usage if its light spectrum must be given.
void verify(const AnalyzeOptions& options);

}  // namespace paim
