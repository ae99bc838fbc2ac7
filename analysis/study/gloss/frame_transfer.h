// Glossy transfer of one pose, straight from its definition, whose outgoing side is in the frame of the
// vertex or in the axes of the pose.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in Dynamic,
//           Low-Frequency Lighting Environments, 2002
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/material/exit_functions.h"
#include "paim/mesh/pose_source.h"

namespace paim::study {

struct FrameTransferOptions {
    uint32_t in_bands = 5;
    uint32_t rays = 512;  // of a vertex
    uint64_t seed = 1;
    uint32_t pose = 0;  // keys the random numbers
};

// T_oi = ∫ V(s) b_o(s) y_i(s) ds of light straight from the sky, with y_i in the axes of the pose and
// b_o in the frames.
// returns  [V][K · C], column k · C + i is that of exit.coefficients()[k]; 0 without a normal
Eigen::MatrixXf frame_transfer(const Topology& topology, const Pose& pose,
                               std::span<const Eigen::Matrix3f> frames, const ExitFunctions& exit,
                               const FrameTransferOptions& options);

// The same with y_o in the axes of the pose, too.
// returns  [V][O · C], column o · C + i
Eigen::MatrixXf in_pose_axes(const Eigen::MatrixXf& in_frames,
                             std::span<const Eigen::Matrix3f> frames, const ExitFunctions& exit);

}  // namespace paim::study
