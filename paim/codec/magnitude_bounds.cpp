// How large the values of a low-rank matrix can be in any pose.
#include "paim/codec/magnitude_bounds.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/half.h"

namespace paim {

namespace {

// A value that is not finite makes it +inf.
double largest_magnitude(std::span<const float> values) {
    float largest = 0.0f;
    bool finite = true;
    for (const float value : values) {
        finite = finite && std::isfinite(value);
        largest = std::max(largest, std::abs(value));
    }
    return finite ? double{largest} : HUGE_VAL;
}

// [K] The largest magnitudes of weights over the poses.
std::vector<double> largest_weights(const LowRank& matrix) {
    PAIM_CHECK_EQ(matrix.weights.size(), size_t{matrix.num_components} * matrix.num_poses);
    std::vector<double> largest;
    for (size_t k = 0; k < matrix.num_components; ++k) {
        largest.push_back(largest_magnitude(
            std::span(matrix.weights).subspan(k * matrix.num_poses, matrix.num_poses)));
    }
    return largest;
}

// maxima  [1 + K] the largest magnitudes of mean and components in a plane
double plane_bound(std::span<const double> maxima, std::span<const double> weights) {
    double bound = maxima[0];
    for (size_t k = 0; k < weights.size(); ++k) bound += weights[k] * maxima[1 + k];
    return bound;
}

// The largest magnitude in a plane, in steps.
double plane_maximum(const StoredValues& values, uint32_t plane, uint32_t num_points) {
    const size_t first = size_t{plane} * num_points;
    if (values.holds_floats()) {
        return largest_magnitude(std::span(values.floats()).subspan(first, num_points));
    }
    double largest = 0.0;
    values.for_each(first, num_points, [&](size_t, float value) {
        largest = std::max(largest, double{std::abs(value)});
    });
    return largest;
}

// An upper bound by the type of integers, without looking at the values; of floats, the same as
// above.
double type_maximum(const StoredValues& values, uint32_t plane, uint32_t num_points) {
    if (values.holds_floats()) return plane_maximum(values, plane, num_points);
    return largest_integer(values.holds_i8() ? Precision::i8 : Precision::i16);
}

using Maximum = double (*)(const StoredValues&, uint32_t, uint32_t);

std::vector<double> bounds_of(const LowRank& matrix, Maximum maximum_of) {
    const std::vector<double> weights = largest_weights(matrix);
    std::vector<double> bounds, maxima(1 + weights.size());
    for (uint32_t plane = 0; plane < matrix.num_planes; ++plane) {
        maxima[0] = maximum_of(matrix.mean, plane, matrix.num_points);
        for (size_t k = 0; k < weights.size(); ++k) {
            maxima[1 + k] = maximum_of(matrix.components[k], plane, matrix.num_points);
        }
        bounds.push_back(plane_bound(maxima, weights) * double{matrix.step(plane)});
    }
    return bounds;
}

}  // namespace

std::vector<double> magnitude_bounds(const LowRank& matrix) {
    PAIM_CHECK_EQ(matrix.mean.size(), matrix.num_rows());
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        PAIM_CHECK_EQ(matrix.components[k].size(), matrix.num_rows());
    }
    // The bounds by the types of integers are nearly always enough. Values are looked at only if
    // not.
    constexpr double kSafe = 1e37;
    std::vector<double> bounds = bounds_of(matrix, &type_maximum);
    if (std::all_of(bounds.begin(), bounds.end(), [](double b) { return b <= kSafe; })) {
        return bounds;
    }
    return bounds_of(matrix, &plane_maximum);
}

StreamedMagnitudes::StreamedMagnitudes(const LowRank& matrix)
    : num_points_(matrix.num_points),
      halves_(matrix.precision == Precision::f16),
      weights_(largest_weights(matrix)),
      maxima_(1 + weights_.size(), 0.0),
      bounds_(matrix.num_planes, 0.0) {}

void StreamedMagnitudes::add(std::span<const float> mean,
                             std::span<const std::span<const float>> components) {
    PAIM_CHECK_EQ(components.size(), weights_.size());
    for (size_t first = 0; first < mean.size();) {
        const uint64_t plane = num_rows_ / num_points_, point = num_rows_ % num_points_;
        PAIM_CHECK_LT(plane, bounds_.size());
        if (point == 0) std::fill(maxima_.begin(), maxima_.end(), 0.0);
        const size_t count = std::min<uint64_t>(mean.size() - first, num_points_ - point);
        maxima_[0] = std::max(maxima_[0], largest_magnitude(mean.subspan(first, count)));
        for (size_t k = 0; k < components.size(); ++k) {
            PAIM_CHECK_EQ(components[k].size(), mean.size());
            double largest = largest_magnitude(components[k].subspan(first, count));
            // Rounding keeps the order, so it may come last.
            if (halves_) largest = from_half(to_half(static_cast<float>(largest)));
            maxima_[1 + k] = std::max(maxima_[1 + k], largest);
        }
        bounds_[plane] = plane_bound(maxima_, weights_);
        num_rows_ += count;
        first += count;
    }
}

}  // namespace paim
