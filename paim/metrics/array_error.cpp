// Errors of decoded values to the baked ones.
#include "paim/metrics/array_error.h"

#include <cmath>
#include <limits>

#include "paim/base/check.h"

namespace paim {

namespace {

// NaN is worse than any number, and stays the worst.
bool is_worse(double error, double worst) {
    return !(error <= worst) && !std::isnan(worst);
}

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double root_mean(double squared_sum, uint64_t count) {
    if (count == 0) return kNothing;
    return std::sqrt(squared_sum / static_cast<double>(count));
}

}  // namespace

double ArrayError::rms() const {
    return root_mean(squared_sum, num_values);
}

double ArrayError::relative() const {
    if (num_values == 0) return kNothing;
    if (reference_squared_sum > 0.0) return std::sqrt(squared_sum / reference_squared_sum);
    return squared_sum > 0.0 ? std::numeric_limits<double>::infinity() : squared_sum;
}

void ArrayError::add(std::span<const float> values, std::span<const float> reference,
                     uint32_t pose) {
    PAIM_CHECK_EQ(values.size(), reference.size());
    for (size_t r = 0; r < values.size(); ++r) {
        const double b = reference[r];
        const double difference = std::abs(values[r] - b);
        squared_sum += difference * difference;
        reference_squared_sum += b * b;
        if (is_worse(difference, worst)) {
            worst = difference;
            worst_index = r;
            worst_pose = pose;
        }
    }
    num_values += values.size();
}

double DistanceError::rms() const {
    return root_mean(squared_sum, num_vertices);
}

void DistanceError::add(std::span<const float> planes, std::span<const float> reference,
                        uint32_t pose) {
    PAIM_CHECK_EQ(planes.size(), reference.size());
    const size_t count = planes.size() / 3;
    for (size_t v = 0; v < count; ++v) {
        double squared = 0.0;
        for (size_t axis = 0; axis < 3; ++axis) {
            const size_t r = axis * count + v;
            const double difference = static_cast<double>(planes[r]) - reference[r];
            squared += difference * difference;
        }
        squared_sum += squared;
        if (is_worse(std::sqrt(squared), worst)) {
            worst = std::sqrt(squared);
            worst_vertex = static_cast<uint32_t>(v);
            worst_pose = pose;
        }
    }
    num_vertices += count;
}

}  // namespace paim
