// Removes a bake, and nothing else.
#pragma once

#include <filesystem>

namespace paim {

// Removes the files of a bake from its directory, the manifest last: what a removal that was stopped
// leaves is still a bake. Then removes the directory, unless other files are in it. Of a symbolic link,
// what it leads to. Nothing happens if there is no such directory.
// Error (output failed) if files cannot be removed.
void remove_bake(const std::filesystem::path& directory);

}  // namespace paim
