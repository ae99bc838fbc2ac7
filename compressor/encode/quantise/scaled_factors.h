// The components of geometry or transfer in memory, before they are quantised.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/encode/noise/shrinkage.h"
#include "compressor/encode/svd/principal_components.h"

namespace paim {

// Pose p is mean + Σ_k weights(k, p) · components[k]. The rows of weights are orthogonal to each
// other and to the constant and have unit RMS, so that an error of a component's value is as large
// an error of the pose, on average, whatever the component: one step suits all of them.
struct ScaledFactors {
    uint32_t num_points = 0;  // vertices, or rows of bases
    uint32_t num_planes = 0;
    std::vector<float> mean;                     // [planes][N]
    std::vector<std::vector<float>> components;  // [K] of [planes][N]
    Eigen::MatrixXd weights;                     // [K][P]
    std::vector<double> singular_values;         // of the whole matrix, unshrunk

    uint32_t num_poses() const { return static_cast<uint32_t>(weights.cols()); }
    uint32_t num_components() const { return static_cast<uint32_t>(components.size()); }
    std::span<const float> plane(const std::vector<float>& values, uint32_t j) const {
        return std::span(values).subspan(size_t{j} * num_points, num_points);
    }
};

// Streams the first components of a data matrix into memory.
// shrinkage   takes noise out of the components, or none
// old_vertex  [V] which vertex of the rows each one is (mesh/cache_order.h)
ScaledFactors read_factors(const RowSource& rows, const PrincipalComponents& components,
                           uint32_t num_components, const Shrinkage* shrinkage,
                           std::span<const uint32_t> old_vertex, uint32_t num_in_flight);

// One of every n points, at random, so that about `num_values` of all values are left: what
// searches try settings on.
ScaledFactors sample(const ScaledFactors& factors, size_t num_values);

// The first components alone.
ScaledFactors first_components(const ScaledFactors& factors, uint32_t num_components);

// The first points alone.
ScaledFactors first_points(const ScaledFactors& factors, uint32_t num_points);

}  // namespace paim
