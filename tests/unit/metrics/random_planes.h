// Planes of normal numbers, the same everywhere for the same key.
#pragma once

#include <Eigen/Core>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/base/vector.h"

namespace paim {

inline Eigen::MatrixXd gaussian(Eigen::Index rows, Eigen::Index columns, uint64_t key) {
    RandomStream random(key);
    Eigen::MatrixXd matrix(rows, columns);
    for (double& x : matrix.reshaped()) {
        // Box and Muller.
        const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
        x = radius * std::cos(2.0 * kPi * random.uniform());
    }
    return matrix;
}

}  // namespace paim
