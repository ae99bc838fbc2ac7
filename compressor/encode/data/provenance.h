// How a bake was made, for people and paim-info.
#pragma once

#include <string>

#include "paim/format/bake/bake_directory.h"

namespace paim {

// A JSON object: what of a bake a .paim keeps in its provenance.
std::string bake_provenance(const BakeIdentity& identity, const PoseStatistics& total);

}  // namespace paim
