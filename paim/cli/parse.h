// Command-line parsing shared by the tools: CLI11 with Paim's exit codes and value forms.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "paim/base/vector.h"

namespace paim::cli {

// Parses argv. Prints help or version and returns 0, or prints what is wrong and returns
// ExitCode::usage; returns -1 when the tool should go on.
int parse(CLI::App& app, int argc, const char* const* argv);

// "0.05" or "5%" as 0.05. Throws Error(usage) naming the option unless it is a finite number >= 0.
double parse_fraction(const std::string& text, const std::string& option);

// "R,G,B" or one number for all three, each in [0, 1]. Throws Error(usage) naming the option.
Vec3f parse_color(const std::string& text, const std::string& option);

// "WxH" in pixels, each 1..16384. Throws Error(usage) naming the option.
std::pair<int, int> parse_size(const std::string& text, const std::string& option);

// The version line that `TOOL --version` prints.
std::string version_text(const std::string& tool);

}  // namespace paim::cli
