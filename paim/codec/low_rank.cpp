// Bounds of low-rank matrices, and removal of components.
#include "paim/codec/low_rank.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/check.h"

namespace paim {

namespace {

// The largest magnitude of each plane, in steps; a value that is not finite makes it +inf.
std::vector<double> plane_maxima(const StoredValues& values, uint32_t num_planes,
                                 uint32_t num_points) {
    std::vector<double> maxima(num_planes, 0.0);
    PAIM_CHECK_EQ(values.size(), size_t{num_planes} * num_points);
    for (uint32_t plane = 0; plane < num_planes; ++plane) {
        float largest = 0.0f;
        bool finite = true;
        values.for_each(size_t{plane} * num_points, num_points, [&](size_t, float value) {
            finite = finite && std::isfinite(value);
            largest = std::max(largest, std::abs(value));
        });
        maxima[plane] = finite ? double{largest} : HUGE_VAL;
    }
    return maxima;
}

// Upper bounds by the type of integers, without looking at the values; of floats, the same as
// above.
std::vector<double> type_maxima(const StoredValues& values, uint32_t num_planes,
                                uint32_t num_points) {
    if (values.holds_floats()) return plane_maxima(values, num_planes, num_points);
    return std::vector<double>(num_planes,
                               largest_integer(values.holds_i8() ? Precision::i8 : Precision::i16));
}

using Maxima = std::vector<double> (*)(const StoredValues&, uint32_t, uint32_t);

std::vector<double> bounds_of(const LowRank& matrix, Maxima maxima_of) {
    std::vector<double> bounds = maxima_of(matrix.mean, matrix.num_planes, matrix.num_points);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        double weight = 0.0;
        for (uint32_t p = 0; p < matrix.num_poses; ++p) {
            weight = std::max(weight,
                              std::abs(double{matrix.weights[size_t{k} * matrix.num_poses + p]}));
        }
        const std::vector<double> maxima =
            maxima_of(matrix.components[k], matrix.num_planes, matrix.num_points);
        for (uint32_t j = 0; j < matrix.num_planes; ++j) bounds[j] += weight * maxima[j];
    }
    for (uint32_t j = 0; j < matrix.num_planes; ++j) bounds[j] *= double{matrix.step(j)};
    return bounds;
}

}  // namespace

LowRank LowRank::still(uint32_t num_planes, StoredValues values, std::vector<float> steps) {
    PAIM_CHECK(num_planes > 0);
    PAIM_CHECK_EQ(values.size() % num_planes, size_t{0});
    LowRank matrix;
    matrix.num_points = static_cast<uint32_t>(values.size() / num_planes);
    matrix.num_planes = num_planes;
    matrix.num_poses = 1;
    matrix.precision = values.holds_floats() ? Precision::f32
                       : values.holds_i8()   ? Precision::i8
                                             : Precision::i16;
    matrix.mean = std::move(values);
    matrix.steps = std::move(steps);
    return matrix;
}

std::vector<float> LowRank::mean_floats() const {
    std::vector<float> result(mean.size());
    mean.widen(0, result);
    if (steps.empty()) return result;
    for (size_t j = 0; j < result.size(); ++j) result[j] *= steps[j / num_points];
    return result;
}

uint32_t LowRank::num_usual_components() const {
    uint32_t count = num_components;
    while (count > 0 && singular_index(count - 1) < singular_values.size() &&
           singular_values[singular_index(count - 1)] == 0.0) {
        --count;
    }
    return count;
}

void LowRank::keep_components(uint32_t count) {
    if (count >= num_components) return;
    num_components = count;
    components.resize(std::min<size_t>(components.size(), count));
    weights.resize(size_t{count} * num_poses);
    if (!weight_steps.empty()) weight_steps.resize(count);
    if (!singular_indices.empty()) singular_indices.resize(count);
    if (!smoothing.empty()) smoothing.resize((1 + size_t{count}) * num_planes);
}

std::vector<double> magnitude_bounds(const LowRank& matrix) {
    // The bounds by the types of integers are nearly always enough. Values are looked at only if
    // not.
    constexpr double kSafe = 1e37;
    std::vector<double> bounds = bounds_of(matrix, type_maxima);
    if (std::all_of(bounds.begin(), bounds.end(), [](double b) { return b <= kSafe; })) {
        return bounds;
    }
    return bounds_of(matrix, plane_maxima);
}

}  // namespace paim
