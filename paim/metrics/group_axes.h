// Orthonormal axes of the vertices that share points (codec/point_groups.h).
// Based on: Vandereycken, Low-Rank Matrix Completion by Riemannian Optimization, 2013 (tangent space
//           of matrices of fixed rank)
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/point_groups.h"

namespace paim {

// The values of a group are a matrix of low rank: a row a vertex, a column a value. To first order, a
// fit of it can change in two ways: points move, or factors do. Changes by points lie in the column
// space of the matrix, which the *vertex axes* span: the factors made orthonormal. Changes by factors
// lie in its row space, which the *point axes* span: the points made orthonormal. Together these are
// the tangent space.
class GroupAxes {
  public:
    explicit GroupAxes(const PointGroups& groups);

    // Call it once for every plane of the points, then orthonormalise_points().
    // points  [K'][N] along K' directions over the poses
    // weight  of squared errors in this plane
    void add_points(const Eigen::MatrixXf& points, double weight);
    void orthonormalise_points();

    uint32_t num_groups() const { return static_cast<uint32_t>(begin_.size() - 1); }
    Eigen::Index num_vertex_axes() const { return num_points_each_; }  // R, of a group
    Eigen::Index num_point_axes() const {
        return num_points_each_ - first_free_;
    }  // R', of a group
    bool is_affine() const { return first_free_ == 1; }

    // Members of all groups, group by group, and the place of a group's first among them.
    std::span<const uint32_t> members(uint32_t g) const {
        return {members_.data() + begin_[g], begin_[g + 1] - begin_[g]};
    }
    Eigen::Index begin(uint32_t g) const { return static_cast<Eigen::Index>(begin_[g]); }

    // Whether a group has point axes. One of fewer than R / 2 vertices has none, because its vertex axes
    // are taken to span all that its vertices can do. So the memory that a file can ask for is bounded
    // by its vertices.
    bool has_point_axes(uint32_t g) const {
        return 2 * (begin(g + 1) - begin(g)) >= num_points_each_;
    }

    // [R][V_g] A column a member. Rows are orthonormal, or zero: those of factors that depend on
    // those before, and those beyond V_g.
    auto vertex_axes(uint32_t g) const {
        return vertex_axes_.middleCols(begin(g), begin(g + 1) - begin(g));
    }
    // [K'][R'] In a plane of the points, of a group that has point axes (checked). Over all planes,
    // with their weights, they are orthonormal, or zero if points depend on those before.
    Eigen::MatrixXf point_axes(uint32_t g, const Eigen::MatrixXf& points) const;
    // [R'][V_g] Coordinates of the decoded members along the point axes.
    Eigen::MatrixXf decoded_coordinates(uint32_t g) const;

    // Memory for groups of R points, with that of the constructor.
    static uint64_t bytes(uint64_t num_vertices, uint64_t num_groups, uint64_t num_points_each);

  private:
    Eigen::Index num_points_each_, first_free_;
    std::vector<size_t> begin_;      // [G + 1]
    std::vector<uint32_t> members_;  // [V]
    Eigen::MatrixXf factors_;        // [R][V] of the members
    Eigen::MatrixXf vertex_axes_;    // [R][V]
    // [G], empty for groups without point axes.
    std::vector<Eigen::MatrixXd> gram_;          // [R][R] products of the points
    std::vector<Eigen::MatrixXd> combinations_;  // [R'][R'] points to their axes
};

}  // namespace paim
