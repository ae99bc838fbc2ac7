// Compared files as CSV, JSON and a section of the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/compare/compare_files.h"
#include "analysis/page.h"
#include "analysis/stage.h"

namespace paim {

// One line for each light and file.
std::string compare_csv(const FileComparison& comparison, const std::vector<NamedLight>& lights);

nlohmann::ordered_json compare_json(const FileComparison& comparison,
                                    const std::vector<NamedLight>& lights);

// reference_name  what pictures are compared with
void add_comparison(Page& page, const FileComparison& comparison, const Stage& stage,
                    const std::string& reference_name);

}  // namespace paim
