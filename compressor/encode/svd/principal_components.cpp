// The principal components of a data matrix, streamed.
// Based on: Alexa and Müller, Representing Animations by Principal Components, 2000; Cardoso and
//           Kry 2012
#include "compressor/encode/svd/principal_components.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compressor/encode/svd/tsqr.h"

namespace paim {

using Eigen::Index;

uint32_t PrincipalComponents::rank() const {
    if (singular_values.empty()) return 0;
    const auto num_poses = v.rows();
    // Reducing P columns rounds about P times. So does each of the folds of kRowsAtOnce rows, by
    // less than 2^-52 of the largest value and at random: √folds. Measured on matrices of exactly
    // known rank: at most a third (6.6 · 2^-52 of 6 poses and a million rows).
    const double num_folds = static_cast<double>(num_rows) / static_cast<double>(kRowsAtOnce);
    const double floor = singular_values[0] *
                         (static_cast<double>(num_poses) + std::sqrt(num_folds)) *
                         std::numeric_limits<double>::epsilon();
    const auto above = std::count_if(singular_values.begin(), singular_values.end(),
                                     [&](double s) { return s > floor; });
    return static_cast<uint32_t>(std::min<Index>(above, num_poses - 1));
}

PrincipalComponents principal_components(const RowSource& rows, uint32_t num_in_flight) {
    // With fewer rows than columns the factor has that many rows; the others are zero.
    const auto count = static_cast<Index>(std::min<uint64_t>(rows.num_rows(), rows.num_columns()));
    SmallSvd svd = jacobi_svd(centred_triangular_factor(rows, num_in_flight).topRows(count));
    PrincipalComponents components;
    components.singular_values.assign(svd.singular_values.begin(), svd.singular_values.end());
    components.v = std::move(svd.v);
    components.num_rows = rows.num_rows();
    return components;
}

std::vector<float> component_weights(const PrincipalComponents& components, uint32_t num_components,
                                     uint64_t num_rows) {
    const auto num_poses = static_cast<uint32_t>(components.v.rows());
    const double to_unit_rms = 1.0 / std::sqrt(static_cast<double>(num_rows));
    std::vector<float> weights(size_t{num_components} * num_poses);
    for (uint32_t k = 0; k < num_components; ++k) {
        for (uint32_t p = 0; p < num_poses; ++p) {
            weights[size_t{k} * num_poses + p] = static_cast<float>(
                components.singular_values[k] * components.v(p, k) * to_unit_rms);
        }
    }
    return weights;
}

}  // namespace paim
