// Checks, before long work, that outputs can be written.
#pragma once

#include <filesystem>

namespace paim {

// Error (output failed), naming the output, unless its directory exists, can be written to and takes
// so long a name. Of a symbolic link, what it leads to is the output.
void check_output(const std::filesystem::path& output);

// The same for a .paim, which must not be a directory either.
void check_paim_output(const std::filesystem::path& output);

}  // namespace paim
