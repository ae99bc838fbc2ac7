// Several .paim files of one bake side by side.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/compare/file_costs.h"
#include "analysis/picture_errors.h"
#include "analysis/reference/reference_pictures.h"
#include "analysis/stage.h"
#include "analysis/temporal/flicker.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/asset_error.h"

namespace paim {

// What is known of a file: what it takes, and what it errs.
struct ComparedFile : FileCosts {
    AssetError error;                 // to the bake, under flat light
    std::vector<PictureErrors> seen;  // [lights] against the reference
    std::vector<Flicker> flicker;     // [lights]
    std::vector<Image> images;        // [lights] of the first measured pose in the first view
};

struct FileComparison {
    std::vector<ComparedFile> files;
    std::vector<Image> reference;         // [lights] of the first measured pose in the first view
    std::vector<double> reference_noise;  // [lights]
};

// on_step  called compare_steps() times
// Errors: those of read_file_of() and measure_asset().
FileComparison compare_files(const std::vector<std::filesystem::path>& paths,
                             const BakeReader& bake, const Stage& stage,
                             const ReferenceSource& reference,
                             const std::function<void()>& on_step);
size_t compare_steps(size_t num_files, const BakeReader& bake, const Stage& stage);

}  // namespace paim
