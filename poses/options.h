// The command line of paim-poses.
#pragma once

#include <cstdint>
#include <string>

namespace paim::poses {

struct Options {
    std::string name;
    std::string directory;
    uint32_t num_poses = 24;
    uint32_t num_vertices = 10'000;
    bool colored = true;  // has an effect on coloured sequences only
    bool json = false;
    int num_threads = 0;  // 0: every core
};

// Fills the options and returns −1, or returns the exit code after help, version or a mistake that
// was printed. Throws Error(usage) for numbers out of range.
int parse_options(int argc, const char* const* argv, Options& options);

}  // namespace paim::poses
