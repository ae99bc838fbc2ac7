// Matrices of random numbers.
#pragma once

#include <Eigen/Core>

#include "paim/base/seed.h"

namespace paim {

// Uniform between -0.5 and 0.5.
inline Eigen::MatrixXf random_matrix(Eigen::Index rows, Eigen::Index columns, uint64_t seed) {
    RandomStream random(seed);
    return Eigen::MatrixXf::NullaryExpr(rows, columns,
                                        [&] { return static_cast<float>(random.uniform() - 0.5); });
}

}  // namespace paim
