// What a bake found out about itself.
#pragma once

#include <cstdint>
#include <span>

#include "paim/mesh/mesh_report.h"

namespace paim {

// Of one pose, or of several.
struct PoseStatistics {
    uint64_t rays = 0;          // traced
    uint64_t blocked = 0;       // of these
    uint32_t zero_normals = 0;  // vertices without a normal: their transfer is 0
    double transfer_rms = 0.0;  // over vertices and coefficients
    double noise_rms = 0.0;     // its estimated standard error, from two independent halves
    PoseReport mesh{};          // 0 in bakes from before it was counted

    // Noise as a fraction of the transfer; 0 where there is none of either.
    double relative_noise() const { return transfer_rms > 0.0 ? noise_rms / transfer_rms : 0.0; }
};

// Counts add up; RMS values are those over all poses.
PoseStatistics combine(std::span<const PoseStatistics> poses);

}  // namespace paim
