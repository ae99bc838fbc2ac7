// The sections of error curves on the page of results.
#pragma once

#include <string>
#include <vector>

#include "analysis/curves.h"
#include "analysis/page.h"
#include "analysis/stage.h"

namespace paim {

// Adds curves, tables, and pictures of all points with their differences from the reference.
// references      [lights] the reference in the first measured pose and the first view
// reference_name  what they are: "the bake"
void add_curves(Page& page, const std::vector<Curve>& curves, const Stage& stage,
                const std::vector<Image>& references, const std::string& reference_name);

}  // namespace paim
