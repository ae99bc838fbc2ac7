// The HTML page with curves, tables and images.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/curves.h"
#include "analysis/stage.h"

namespace paim {

// references  [lights] the bake in the first measured pose
// Writes the images of all points (and their differences from the bake, times four) as PNG into
// directory/images, and index.html. Errors: output failed.
void write_report(const std::filesystem::path& directory, const std::string& title,
                  const std::string& summary, const std::vector<Curve>& curves, const Stage& stage,
                  const std::vector<Image>& references, bool with_plots);

}  // namespace paim
