// Runs gnuplot, which draws charts as SVG.
#pragma once

#include <filesystem>
#include <string>

namespace paim {

// Whether gnuplot can be run.
bool have_gnuplot();

// Runs a script that writes the output. Error (output failed) if gnuplot fails, which says why on stderr.
void run_gnuplot(const std::string& script, const std::filesystem::path& output);

// Text in gnuplot's single quotes. Control characters, which file names may have, become blanks: a
// line feed would end the string, and gnuplot would run the text after it as a command.
std::string gnuplot_text(const std::string& text);

// The first lines of a script: an SVG of this title on white.
std::string gnuplot_begin(const std::filesystem::path& output, const std::string& title);

}  // namespace paim
