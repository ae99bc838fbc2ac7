// Statistics of a bake.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/mesh_report.h"
#include "paim/transfer/layout.h"

namespace paim {

// Statistics of one pose, or of several.
struct PoseStatistics {
    uint64_t rays = 0;          // traced
    uint64_t occluded = 0;      // of these
    uint32_t zero_normals = 0;  // vertices without a normal: their transfer is 0
    uint32_t above_target = 0;  // vertices whose noise is above the target
    // [bands] RMS over the vertices, channels and coefficients of a band.
    std::vector<double> transfer_rms;
    // The standard error of the transfer, estimated from the two halves of the rays.
    std::vector<double> noise_rms;
    PoseReport mesh{};  // 0 in old bakes, which did not count these
    // Rays that hit the back of a face, which bounces no light.
    uint64_t back_hits = 0;
    // [bands of gloss] The same of the glossy transfer, over its rows and all of its coefficients;
    // empty if there is none.
    std::vector<double> gloss_rms;
    std::vector<double> gloss_noise_rms;

    // Those of the glossy transfer in the place of those of the transfer.
    PoseStatistics of_gloss() const;

    // Noise as a fraction of the transfer over all coefficients; not a number if both are 0.
    double relative_noise() const;
};

// [in_bands] Root mean square of planes (transfer/layout.h) over the vertices, channels, and
// coefficients of each band of light, of all outgoing coefficients.
std::vector<double> rms_by_band(const TransferLayout& layout, std::span<const float> planes);

// Adds counts, and computes RMS values over all poses, which have the same number of bands
// (checked).
PoseStatistics combine(std::span<const PoseStatistics> poses);

}  // namespace paim
