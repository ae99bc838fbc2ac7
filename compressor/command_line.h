// The command line of paim-compress.
#pragma once

#include <optional>

#include "compressor/options.h"

namespace paim {

// Parses the command line. Returns nothing when the tool is done (help, version, usage error), with
// the exit code in exit_code. Throws Error(usage) for values out of range.
std::optional<CompressOptions> parse_options(int argc, const char* const* argv, int& exit_code);

}  // namespace paim
