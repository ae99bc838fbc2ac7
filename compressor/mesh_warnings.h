// What paim-compress says about odd meshes, in words and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "paim/mesh/mesh_report.h"

namespace paim {

// One line for each kind that is there, with what it means for the light.
std::vector<std::string> mesh_warnings(const TopologyReport& report);

// The same of counts over all poses.
std::vector<std::string> mesh_warnings(const PoseReport& total);

// Both of a mesh that stands still; lines begin with its file.
std::vector<std::string> static_mesh_warnings(const std::string& file, const TopologyReport& report,
                                              const PoseReport& pose);

// All counts, zeros too.
nlohmann::ordered_json mesh_json(const TopologyReport& report, const PoseReport& total);

}  // namespace paim
