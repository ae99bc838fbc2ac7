// How a bake was made, for people and paim-info.
#pragma once

#include <string>

#include "paim/format/bake/bake_directory.h"

namespace paim {

// The JSON object with which a .paim states the bake that it was made from.
std::string bake_provenance(const BakeIdentity& identity, const PoseStatistics& total);

}  // namespace paim
