// Error curves as SVG, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/curves.h"
#include "analysis/stage.h"

namespace paim {

// Writes NAME.svg (error against the setting) and NAME_bytes.svg, NAME_time.svg (visual error
// against bytes and decode time) into the directory. A plot without any error is not drawn, and
// removed if it is there. Error (output failed) if gnuplot fails, which says why on stderr.
void write_plots(const std::filesystem::path& directory, const Curve& curve,
                 const std::vector<NamedLight>& lights);

}  // namespace paim
