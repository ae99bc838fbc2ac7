// What paim-compress says about outliers of a bake.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/outliers.h"

namespace paim {

// One line for each of the first poses that have outliers, with the vertex that is farthest from
// where it usually is, and a last line if there are more such poses. Nothing without outliers.
std::vector<std::string> outlier_notes(const BakeIdentity& bake, const PositionOutliers& outliers);

// An object for each pose that has outliers.
nlohmann::ordered_json outliers_json(const BakeIdentity& bake, const PositionOutliers& outliers);

}  // namespace paim
