// What a bake found out about itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/mesh_report.h"
#include "paim/transfer/layout.h"

namespace paim {

// Of one pose, or of several.
struct PoseStatistics {
    uint64_t rays = 0;          // traced
    uint64_t occluded = 0;      // of these
    uint32_t zero_normals = 0;  // vertices without a normal: their transfer is 0
    uint32_t above_target = 0;  // vertices still above the transfer error asked for
    // [bands] over the vertices, channels and coefficients of a band.
    std::vector<double> transfer_rms;
    std::vector<double>
        noise_rms;  // standard error of the transfer, estimated from the two halves of the rays
    PoseReport mesh{};              // 0 in bakes from before it was counted
    // Rays whose light would have bounced off the back of a face: it did not.
    uint64_t back_hits = 0;

    // Noise as a fraction of the transfer over all coefficients; 0 where there is none of either.
    double relative_noise() const;
};

// The root mean square of planes (transfer/layout.h) over all but the band, [bands].
std::vector<double> rms_by_band(const TransferLayout& layout, std::span<const float> planes);

// Counts add up; RMS values are those over all poses, which have the same number of bands
// (checked).
PoseStatistics combine(std::span<const PoseStatistics> poses);

}  // namespace paim
