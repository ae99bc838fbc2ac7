// Natural order of file names: x_2 before x_10.
#pragma once

#include <filesystem>
#include <string_view>

namespace paim {

// True if a comes before b. Runs of the digits 0-9 compare as numbers of any length, everything
// else byte by byte; names that are equal so far (x_2, x_02) compare as bytes. A total order.
bool natural_less(std::string_view a, std::string_view b);

// The same for paths, folder by folder, so that the files of a folder stay together.
bool natural_path_less(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace paim
