// Orthonormal axes of the vertices that share points.
// Based on: Vandereycken 2013 (see the header); Parlett, The Symmetric Eigenvalue Problem, 1980 (Gram and Schmidt, twice is enough)
#include "paim/metrics/group_axes.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

namespace {

// Combinations of vectors that are orthonormal: T with T gram Tᵀ = 1, in the order of the vectors.
// The row of a vector is zero if those before it leave less than 1e-9 of its square.
MatrixXd orthonormal_combinations(const MatrixXd& gram) {
    constexpr double kNothingNew = 1e-9;
    MatrixXd rows = MatrixXd::Zero(gram.rows(), gram.rows());
    for (Index j = 0; j < gram.rows(); ++j) {
        VectorXd t = VectorXd::Unit(gram.rows(), j);
        for (int pass = 0; pass < 2; ++pass) {
            const VectorXd along = rows.topRows(j) * (gram * t);
            t -= rows.topRows(j).transpose() * along;
        }
        const double left = t.dot(gram * t);
        if (left > kNothingNew * gram(j, j)) rows.row(j) = t.transpose() / std::sqrt(left);
    }
    return rows;
}

}  // namespace

GroupAxes::GroupAxes(const PointGroups& groups)
    : num_points_each_(groups.factors.cols()),
      first_free_(groups.is_affine ? 1 : 0),
      begin_(size_t{groups.num_groups} + 1, 0),
      members_(groups.group.size()) {
    PAIM_CHECK_EQ(groups.factors.rows(), static_cast<Index>(groups.group.size()));
    for (const uint32_t g : groups.group) {
        PAIM_CHECK_LT(g, groups.num_groups);
        ++begin_[g + 1];
    }
    for (size_t g = 1; g < begin_.size(); ++g) begin_[g] += begin_[g - 1];
    std::vector<size_t> next(begin_.begin(), begin_.end() - 1);
    for (uint32_t v = 0; v < groups.group.size(); ++v) members_[next[groups.group[v]]++] = v;
    factors_ = groups.factors(members_, Eigen::all).transpose();
    vertex_axes_.resize(factors_.rows(), factors_.cols());
    gram_.resize(groups.num_groups);
    parallel_for(num_groups(), 1, [&](size_t j, size_t) {
        const auto g = static_cast<uint32_t>(j);
        const Index size = begin(g + 1) - begin(g);
        auto axes = vertex_axes_.middleCols(begin(g), size);
        if (!has_point_axes(g)) {
            axes.setIdentity();
            return;
        }
        const MatrixXd factors = factors_.middleCols(begin(g), size).cast<double>();
        axes = (orthonormal_combinations(factors * factors.transpose()) * factors).cast<float>();
        gram_[g].setZero(num_points_each_, num_points_each_);
    });
}

void GroupAxes::add_points(const MatrixXf& points, double weight) {
    PAIM_CHECK_EQ(points.cols(), static_cast<Index>(gram_.size()) * num_points_each_);
    parallel_for(num_groups(), 1, [&](size_t g, size_t) {
        if (gram_[g].size() == 0) return;
        const MatrixXd of_group =
            points.middleCols(static_cast<Index>(g) * num_points_each_, num_points_each_)
                .cast<double>();
        gram_[g] += weight * (of_group.transpose() * of_group);
    });
}

void GroupAxes::orthonormalise_points() {
    combinations_.resize(gram_.size());
    parallel_for(num_groups(), 1, [&](size_t g, size_t) {
        if (gram_[g].size() == 0) return;
        combinations_[g] = orthonormal_combinations(
            gram_[g].bottomRightCorner(num_point_axes(), num_point_axes()));
    });
}

MatrixXf GroupAxes::point_axes(uint32_t g, const MatrixXf& points) const {
    PAIM_CHECK(has_point_axes(g));
    return points.middleCols(Index{g} * num_points_each_ + first_free_, num_point_axes()) *
           combinations_[g].transpose().cast<float>();
}

MatrixXf GroupAxes::decoded_coordinates(uint32_t g) const {
    PAIM_CHECK(has_point_axes(g));
    const MatrixXd of_points = combinations_[g] * gram_[g].bottomRows(num_point_axes());
    return of_points.cast<float>() * factors_.middleCols(begin(g), begin(g + 1) - begin(g));
}

uint64_t GroupAxes::bytes(uint64_t num_vertices, uint64_t num_groups, uint64_t num_points_each) {
    // Factors and axes; factors and axes of a group as doubles while these are made, which is all of
    // them if there is one group. Only groups of R / 2 vertices or more have products.
    const uint64_t values = num_vertices * num_points_each;
    const uint64_t num_products = std::min(num_groups, 1 + 2 * num_vertices / num_points_each);
    return num_vertices * sizeof(uint32_t) + 2 * values * (sizeof(float) + sizeof(double)) +
           2 * num_products * num_points_each * num_points_each * sizeof(double);
}

}  // namespace paim
