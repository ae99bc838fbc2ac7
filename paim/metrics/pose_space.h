// The span of a decoder over the poses: the sequences of values that it can produce.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>

namespace paim {

// Orthonormal basis of all sequences over the poses that a decoder with these weights can produce.
// The first vector is constant (for the mean). Then each row of weights adds its part that is
// orthogonal to the vectors before it, unless that part is zero up to rounding.
// weights  [K][P], a row a component
// returns  [P][K'], 1 <= K' <= min(K + 1, P)
// Errors: bad input for weights that are not finite.
Eigen::MatrixXd orthonormal_pose_space(std::span<const float> weights, uint32_t num_poses);

}  // namespace paim
