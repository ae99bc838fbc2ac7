// The command line that makes the file of a point.
#pragma once

#include <filesystem>
#include <string>

#include "analysis/trade/trade_point.h"

namespace paim {

// A word of a shell command: in single quotes if it needs them.
std::string shell_word(const std::string& word);

// The name of files of this bake, without ".paim"; it is stated in them.
std::string file_stem(const std::filesystem::path& bake);

// The options that make the file of a point of a bake: "--max-error 3.5% …".
std::string encode_arguments(const TradeSettings& settings);

// "paim-compress encode x.bake -o x.paim --max-error 3.5% …", to be pasted into a shell. Where another
// bake is needed, its command comes first, joined by "&&", with POSES for the files of the poses; the
// options of the given bake have to be added to it.
std::string encode_command(const std::filesystem::path& bake, const TradeSettings& settings);

}  // namespace paim
