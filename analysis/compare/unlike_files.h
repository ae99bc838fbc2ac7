// How unlike several .paim files are, where no truth is known.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/column.h"
#include "analysis/compare/file_costs.h"
#include "analysis/page.h"
#include "analysis/picture_errors.h"
#include "analysis/stage.h"

namespace paim {

struct UnlikeFile : FileCosts {
    // As the file states them; not a number if it states none.
    double stated_transfer_error = 0.0, stated_position_error = 0.0;
    std::vector<PictureErrors> differences;  // [lights] from the first file's pictures, by those
    std::vector<Image> images;               // [lights] of the first pose in the first view
};

// Plays files of one sequence under the same lights and seen by the same cameras, which see the first one.
// on_step  called unlike_steps() times
// Errors: those of read_paim(); bad input if numbers of poses differ.
std::vector<UnlikeFile> compare_played(const std::vector<std::filesystem::path>& paths,
                                       const std::vector<NamedLight>& lights,
                                       const StageOptions& options,
                                       const std::function<void()>& on_step);
size_t unlike_steps(size_t num_files, const StageOptions& options);

// One line for each light and file.
std::string unlike_csv(const std::vector<UnlikeFile>& files, const std::vector<NamedLight>& lights);

// The same numbers by the same names: those of a light below "lights".
nlohmann::ordered_json unlike_json(const std::vector<UnlikeFile>& files,
                                   const std::vector<NamedLight>& lights);

void add_unlike(Page& page, const std::vector<UnlikeFile>& files,
                const std::vector<NamedLight>& lights);

}  // namespace paim
