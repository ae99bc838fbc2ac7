// Checks, before long work, that outputs can be written.
#pragma once

#include <cstdint>
#include <filesystem>

namespace paim {

// Error (output failed), naming the output, unless its directory exists, can be written to and takes
// so long a name. Of a symbolic link, what it leads to is the output.
void check_output(const std::filesystem::path& output);

// The same for a .paim, which must not be a directory either.
void check_paim_output(const std::filesystem::path& output);

// Error (output failed) if the disk has less space than the poses that a bake lacks will take.
// directory   of the bake, which may not exist yet
// pose_bytes  size of the file of a pose
// first, last  the poses to bake, inclusive
void check_bake_space(const std::filesystem::path& directory, uint64_t pose_bytes, uint32_t first,
                      uint32_t last);

}  // namespace paim
