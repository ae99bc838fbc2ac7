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

// [V] columns: tangent, bitangent, normal, which are a rotation. The tangent follows the first edge of
// the vertex, projected into the plane of the normal: that from the vertex to the next corner of the
// first triangle that has it. Where this edge is along the normal or there is none, the tangent is any
// direction in the plane. Vertices without a normal have the axes of the pose.
std::vector<Eigen::Matrix3f> vertex_frames(const Topology& topology, const Pose& pose);

// Angles by which the frames of a pose are turned about their normals, so that tangents of neighbours
// point alike there: to the first of the axes of the pose, projected into the plane of the normal.
// frames   those of vertex_frames() of the pose
// returns  [V] radians
std::vector<float> agreeing_angles(std::span<const Eigen::Matrix3f> frames);

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

// The same in frames that are turned about their normals.
// angles  [V] radians, counter-clockwise seen from outside
Eigen::MatrixXf in_turned_frames(const Eigen::MatrixXf& in_frames, std::span<const float> angles,
                                 const ExitFunctions& exit);

// The same with y_o in the axes of the pose, too.
// returns  [V][O · C], column o · C + i
Eigen::MatrixXf in_pose_axes(const Eigen::MatrixXf& in_frames,
                             std::span<const Eigen::Matrix3f> frames, const ExitFunctions& exit);

}  // namespace paim::study
