// Natural order of file names: x_2 before x_10, t-2 before t0, t.1.25 before t.1.5.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace paim {

// True if a comes before b. Runs of the digits 0-9 compare as numbers of any length, everything
// else byte by byte; names that are equal so far (x_2, x_02) compare as bytes. A total order.
bool natural_less(std::string_view a, std::string_view b);

// Sorts paths folder by folder, so that the files of a folder stay together, in front of those of
// its subfolders. Folders are in the order of natural_less(). Files of a folder compare without
// their extensions, with numbers that may have signs and fractions (name_numbers.h), then by their
// extensions, then as bytes. The result does not depend on the order of `paths`.
void sort_naturally(std::vector<std::filesystem::path>& paths);

}  // namespace paim
