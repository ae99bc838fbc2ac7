// The part of the poses' space that a decoder can follow.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>

namespace paim {

// Orthonormal basis of all sequences over the poses that a decoder with these weights can make: the
// constant (the mean) and then the weights one after another, each without what those before it
// already reach; those that reach nothing new are left out.
// weights  [K][P], a row a component
// returns  [P][K'], 1 <= K' <= min(K + 1, P)
// Errors: bad input for weights that are not finite.
Eigen::MatrixXd orthonormal_pose_space(std::span<const float> weights, uint32_t num_poses);

}  // namespace paim
