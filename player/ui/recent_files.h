// The files that were opened last, kept from one window to the next.
#pragma once

#include <filesystem>
#include <vector>

namespace paim::player {

// In $XDG_STATE_HOME/paim/recent (~/.local/state/paim/recent), newest first; those that are still there.
// Empty where that cannot be read.
std::vector<std::filesystem::path> read_recent_files();

// Puts a file first, and returns the list. Where the list cannot be written, it is not kept.
std::vector<std::filesystem::path> add_recent_file(const std::filesystem::path& path);

}  // namespace paim::player
