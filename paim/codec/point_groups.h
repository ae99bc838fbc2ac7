// How a codec makes vertices out of the points of its matrix.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace paim {

// Vertices of a group are combinations of the R points of the group:
//   vertex v = Σ_r factors(v, r) · point (group[v] R + r)
struct PointGroups {
    uint32_t num_groups = 0;
    std::vector<uint32_t> group;  // [V]
    Eigen::MatrixXf factors;      // [V][R] finite
    bool is_affine = false;       // whether the first factor is the same for all of a group
};

}  // namespace paim
