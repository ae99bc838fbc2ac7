// The components of geometry or transfer in memory.
#include "compressor/encode/quantise/scaled_factors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compressor/encode/svd/projected_blocks.h"
#include "paim/base/check.h"
#include "paim/base/seed.h"

namespace paim {

using Eigen::Index;

ScaledFactors read_factors(const RowSource& rows, const PrincipalComponents& components,
                           uint32_t num_components, const Shrinkage* shrinkage,
                           std::span<const uint32_t> old_vertex, uint32_t num_in_flight) {
    const size_t num_vertices = old_vertex.size();
    PAIM_CHECK(num_vertices > 0);
    std::vector<size_t> new_vertex(num_vertices);
    for (size_t v = 0; v < num_vertices; ++v) new_vertex[old_vertex[v]] = v;
    const auto num_poses = static_cast<double>(rows.num_columns());

    ScaledFactors factors;
    factors.num_points = static_cast<uint32_t>(num_vertices);
    factors.num_planes = static_cast<uint32_t>(rows.num_rows() / num_vertices);
    factors.singular_values = components.singular_values;
    factors.weights = std::sqrt(num_poses) *
                      components.v.leftCols(static_cast<Index>(num_components)).transpose();
    factors.mean.resize(rows.num_rows());
    factors.components.assign(num_components, std::vector<float>(rows.num_rows()));

    uint64_t first = 0;
    const auto take = [&](EncodedRows& block) {
        if (shrinkage != nullptr) shrinkage->apply(first, block.components);
        const auto scatter = [&](const std::vector<float>& from, float scale, float* to) {
            for (size_t r = 0; r < from.size(); ++r) {
                const size_t plane = (first + r) / num_vertices;
                to[plane * num_vertices + new_vertex[(first + r) % num_vertices]] = scale * from[r];
            }
        };
        scatter(block.mean, 1.0f, factors.mean.data());
        for (uint32_t k = 0; k < num_components; ++k) {
            // From unit RMS to what goes with weights of unit RMS.
            const double scale = components.singular_values[k] /
                                 std::sqrt(static_cast<double>(rows.num_rows()) * num_poses);
            scatter(block.components[k], static_cast<float>(scale), factors.components[k].data());
        }
        first += block.mean.size();
    };
    for_each_encoded_block(rows, components, num_components, take, num_in_flight);
    return factors;
}

namespace {

// These points alone.
ScaledFactors some_points(const ScaledFactors& factors, std::span<const uint32_t> points) {
    const auto thin = [&](const std::vector<float>& from) {
        std::vector<float> to;
        to.reserve(points.size() * factors.num_planes);
        for (uint32_t j = 0; j < factors.num_planes; ++j) {
            const auto plane = factors.plane(from, j);
            for (const uint32_t n : points) to.push_back(plane[n]);
        }
        return to;
    };
    ScaledFactors few;
    few.num_planes = factors.num_planes;
    few.mean = thin(factors.mean);
    few.num_points = static_cast<uint32_t>(points.size());
    for (const auto& component : factors.components) few.components.push_back(thin(component));
    few.weights = factors.weights;
    few.singular_values = factors.singular_values;
    return few;
}

}  // namespace

ScaledFactors sample(const ScaledFactors& factors, size_t num_values) {
    const size_t all = factors.mean.size() * (factors.components.size() + 1);
    const size_t stride =
        std::clamp<size_t>(all / std::max<size_t>(1, num_values), 1, factors.num_points);
    // Not every n-th point: rows of bases repeat, a mean and its components.
    std::vector<uint32_t> points;
    for (size_t first = 0; first < factors.num_points; first += stride) {
        const size_t some = std::min(stride, factors.num_points - first);
        points.push_back(static_cast<uint32_t>(first + mix_bits(first) % some));
    }
    return some_points(factors, points);
}

ScaledFactors first_components(const ScaledFactors& factors, uint32_t num_components) {
    PAIM_CHECK_LE(num_components, factors.num_components());
    ScaledFactors few;
    few.num_points = factors.num_points;
    few.num_planes = factors.num_planes;
    few.mean = factors.mean;
    few.components.assign(factors.components.begin(), factors.components.begin() + num_components);
    few.weights = factors.weights.topRows(num_components);
    few.singular_values = factors.singular_values;
    return few;
}

ScaledFactors first_points(const ScaledFactors& factors, uint32_t num_points) {
    PAIM_CHECK_LE(num_points, factors.num_points);
    std::vector<uint32_t> points(num_points);
    std::iota(points.begin(), points.end(), 0u);
    return some_points(factors, points);
}

}  // namespace paim
