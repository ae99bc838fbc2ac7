// Measurements behind the defaults of the bake. Each study prints a CSV on stdout.
#pragma once

#include <string>
#include <vector>

#include "paim/mesh/pose_source.h"

namespace paim::study {

struct StudyOptions {
    std::string name;        // of the sequence, first column of the CSV
    uint32_t num_poses = 0;  // number of poses, from the first on
    uint32_t bands = 5;
    uint32_t truth_rays = 4096;   // of the bake that is used as the truth
    std::vector<uint32_t> rays;   // to try
    std::vector<double> targets;  // transfer errors to try
};

// True error and flicker of encoded transfer for numbers of rays, random streams, numbers of
// components and treatments of the noise in these. The cell for flicker is empty if there is one
// pose only.
void study_noise(const PoseSource& source, const StudyOptions& options);

// True error of the bake for numbers of rays, for each sampler.
void study_samplers(const PoseSource& source, const StudyOptions& options);

// Rays and true error of bakes with noise targets, and with fixed numbers of rays.
void study_targets(const PoseSource& source, const StudyOptions& options);

}  // namespace paim::study
