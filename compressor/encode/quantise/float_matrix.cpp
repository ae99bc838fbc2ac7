// ScaledFactors as floats.
#include "compressor/encode/quantise/float_matrix.h"

#include <algorithm>
#include <cmath>

#include "paim/base/half.h"

namespace paim {

namespace {

double root_mean_square(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) sum += static_cast<double>(value) * static_cast<double>(value);
    return values.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

LowRank float_matrix(const ScaledFactors& factors, uint32_t num_components, Precision precision) {
    LowRank matrix;
    matrix.num_points = factors.num_points;
    matrix.num_planes = factors.num_planes;
    matrix.num_poses = factors.num_poses();
    matrix.num_components = std::min(num_components, factors.num_components());
    matrix.precision = precision;
    matrix.mean = factors.mean;
    matrix.singular_values = factors.singular_values;
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        std::vector<float> component = factors.components[k];
        const double rms = root_mean_square(component);
        const auto scale = static_cast<float>(rms > 0.0 ? 1.0 / rms : 1.0);
        for (float& value : component) {
            value *= scale;
            if (precision == Precision::f16) value = from_half(to_half(value));
        }
        matrix.components.emplace_back(std::move(component));
        for (Eigen::Index p = 0; p < factors.weights.cols(); ++p) {
            matrix.weights.push_back(static_cast<float>(
                factors.weights(static_cast<Eigen::Index>(k), p) / static_cast<double>(scale)));
        }
    }
    return matrix;
}

}  // namespace paim
