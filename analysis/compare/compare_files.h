// Several .paim files of one bake side by side.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "analysis/picture_errors.h"
#include "analysis/reference/reference_pictures.h"
#include "analysis/stable_time.h"
#include "analysis/stage.h"
#include "analysis/temporal/flicker.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/asset_error.h"

namespace paim {

// What is known of a file: what it takes, and what it errs.
struct ComparedFile {
    std::filesystem::path path;
    std::string codec;
    uint32_t bands = 0;
    uint32_t geometry_components = 0, transfer_components = 0;
    uint64_t size_bytes = 0;
    double bits_per_vertex_per_pose = 0.0;
    // Of the lit transfer and of the positions, per vertex and frame, and on the CPU once a frame.
    uint64_t multiply_adds = 0, position_multiply_adds = 0, cpu_multiply_adds = 0;
    PoseTime frame;                   // positions and radiance of a frame on the CPU
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
// Errors: those of read_paim() and measure_asset().
FileComparison compare_files(const std::vector<std::filesystem::path>& paths,
                             const BakeReader& bake, const Stage& stage,
                             const ReferenceSource& reference,
                             const std::function<void()>& on_step);
size_t compare_steps(size_t num_files, const BakeReader& bake, const Stage& stage);

}  // namespace paim
