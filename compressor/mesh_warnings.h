// Warnings of paim-compress about oddities of a mesh, as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "paim/mesh/mesh_report.h"

namespace paim {

// A line for each kind of oddity that was found, with its effect on the light.
std::vector<std::string> mesh_warnings(const TopologyReport& report);

// The same for counts over all poses.
std::vector<std::string> mesh_warnings(const PoseReport& total);

// Both for the still mesh of one file; lines begin with its name.
std::vector<std::string> still_mesh_warnings(const std::string& file, const TopologyReport& report,
                                             const PoseReport& pose);

// Prints each as a line on stderr.
void print_warnings(const std::vector<std::string>& warnings);

// The same for notes: what may well be meant, but often is a mistake.
void print_notes(const std::vector<std::string>& notes);

// All counts, also those that are 0.
nlohmann::ordered_json mesh_json(const TopologyReport& report, const PoseReport& total);

}  // namespace paim
