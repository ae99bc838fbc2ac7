// The span of a decoder over the poses.
// Based on: Parlett, The Symmetric Eigenvalue Problem, 1980 (Gram and Schmidt, twice is enough)
#include "paim/metrics/pose_space.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd orthonormal_pose_space(std::span<const float> weights, uint32_t num_poses) {
    PAIM_CHECK_LE(1u, num_poses);
    PAIM_CHECK_EQ(weights.size() % num_poses, 0u);
    const auto poses = static_cast<Index>(num_poses);
    const auto components = static_cast<Index>(weights.size()) / poses;
    // Relative size of the rounding of a weight that is a sum of other ones, as floats.
    constexpr double kNothingNew = 1e-6;
    MatrixXd basis(poses, std::min(components + 1, poses));
    basis.col(0).setConstant(1.0 / std::sqrt(static_cast<double>(num_poses)));
    Index found = 1;
    for (Index k = 0; k < components && found < basis.cols(); ++k) {
        const Eigen::Map<const Eigen::VectorXf> row(weights.data() + k * poses, poses);
        if (!row.allFinite()) throw_bad_input("weights of component {}: not a finite number", k);
        VectorXd direction = row.cast<double>().stableNormalized();
        for (int pass = 0; pass < 2; ++pass) {
            const auto before = basis.leftCols(found);
            direction -= before * (before.transpose() * direction).eval();
            if (!(direction.norm() > kNothingNew)) break;
        }
        if (!(direction.norm() > kNothingNew)) continue;
        basis.col(found++) = direction.normalized();
    }
    return basis.leftCols(found);
}

}  // namespace paim
