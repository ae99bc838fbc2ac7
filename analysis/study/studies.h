// What the bake's defaults rest on: each study prints a CSV on stdout.
#pragma once

#include <string>
#include <vector>

#include "paim/mesh/pose_source.h"

namespace paim::study {

struct StudyOptions {
    std::string name;        // of the sequence, first column of the CSV
    uint32_t num_poses = 0;  // the first so many
    uint32_t bands = 5;
    uint32_t truth_rays = 4096;   // of the bake that counts as the truth
    std::vector<uint32_t> rays;   // to try
    std::vector<double> targets;  // transfer errors to try
};

// True error and flicker of encoded transfer, against rays, random streams, number of components
// and how the noise in them is treated. One pose has no flicker: its cell is empty.
void study_noise(const PoseSource& source, const StudyOptions& options);

// True error of the bake itself against rays, for each sampler.
void study_samplers(const PoseSource& source, const StudyOptions& options);

// Rays and true error of bakes to an error target and of fixed counts.
void study_targets(const PoseSource& source, const StudyOptions& options);

}  // namespace paim::study
