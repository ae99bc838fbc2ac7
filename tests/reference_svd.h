// Eigen's SVD as the slow reference, compiled once for all tests.
#pragma once

#include <Eigen/Core>

namespace paim {

struct ReferenceSvd {
    Eigen::VectorXd singular_values;  // descending
    Eigen::MatrixXd u;                // [rows][min(rows, columns)]
};

ReferenceSvd reference_svd(const Eigen::MatrixXd& matrix);

}  // namespace paim
