// Eigen's SVD as the slow reference.
#include "tests/reference_svd.h"

#include <Eigen/SVD>

namespace paim {

ReferenceSvd reference_svd(const Eigen::MatrixXd& matrix) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU);
    return {svd.singularValues(), svd.matrixU()};
}

}  // namespace paim
