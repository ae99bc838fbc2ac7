// Outliers as components of their own.
#include "compressor/encode/quantise/exceptions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/half.h"

namespace paim {

namespace {

Vec3d difference(const PositionOutlier& outlier) {
    const Vec3f nearer = outlier.position.cwiseMax(-kFarthestOutlier).cwiseMin(kFarthestOutlier);
    return nearer.cast<double>() - outlier.usual.cast<double>();
}

// The weight in one pose, a multiple of a step of 2^-14 of it.
void append_weight(uint32_t pose, float weight, bool has_steps, LowRank& matrix) {
    const size_t first = matrix.weights.size();
    matrix.weights.resize(first + matrix.num_poses, 0.0f);
    matrix.weights[first + pose] = weight;
    if (has_steps) matrix.weight_steps.push_back(std::ldexp(weight, -14));
    // The singular value 0 goes with the exception, behind all others.
    const auto index = static_cast<uint32_t>(matrix.singular_values.size());
    if (matrix.singular_indices.empty() && index != matrix.num_components) {
        for (uint32_t k = 0; k < matrix.num_components; ++k) matrix.singular_indices.push_back(k);
        matrix.singular_indices.push_back(index);
    } else if (!matrix.singular_indices.empty()) {
        matrix.singular_indices.push_back(index);
    }
    matrix.singular_values.push_back(0.0);
    ++matrix.num_components;
}

// Exceptions of one pose of a matrix of integers.
class IntegerExceptions {
  public:
    IntegerExceptions(std::span<const PositionOutlier> outliers, LowRank& matrix)
        : outliers_(outliers), matrix_(matrix), scale_(1u << matrix.fraction_bits) {
        for (const PositionOutlier& outlier : outliers) rest_.push_back(difference(outlier));
    }

    void append() {
        for (uint32_t j = 0; j < kExceptionsPerPose; ++j) {
            const double largest = largest_in_steps();
            if (j > 0 && largest <= 1.0) return;
            append_one(largest);
        }
    }

  private:
    // Of the integers in the file.
    double step(int axis) const {
        return scale_ * double{matrix_.step(static_cast<uint32_t>(axis))};
    }

    double largest_in_steps() const {
        double largest = 0.0;
        for (const Vec3d& rest : rest_) {
            for (int axis = 0; axis < 3; ++axis) {
                largest = std::max(largest, std::abs(rest[axis]) / step(axis));
            }
        }
        return largest;
    }

    void append_one(double largest) {
        // Half a step of room, as check_smoothing() asks for.
        const double most = std::floor(largest_integer(Precision::i16) / scale_ - 0.5);
        // Decoders add up weights times integers of 16 bits, which must be finite floats.
        constexpr double kMostWeight = 1e33;
        const auto weight = static_cast<float>(std::clamp(largest / most, 1.0, kMostWeight));
        std::vector<int16_t> values(matrix_.num_rows(), 0);
        for (size_t j = 0; j < rest_.size(); ++j) {
            for (int axis = 0; axis < 3; ++axis) {
                const double unit = step(axis) * double{weight};
                const double q = std::clamp(std::nearbyint(rest_[j][axis] / unit), -most, most);
                rest_[j][axis] -= unit * q;
                values[static_cast<size_t>(axis) * matrix_.num_points + outliers_[j].vertex] =
                    static_cast<int16_t>(scale_ * q);
            }
        }
        matrix_.components.emplace_back(std::move(values));
        matrix_.precision = Precision::i16;
        if (!matrix_.smoothing.empty()) {
            matrix_.smoothing.resize(matrix_.smoothing.size() + matrix_.num_planes, 0);
        }
        append_weight(outliers_[0].pose, weight, true, matrix_);
    }

    const std::span<const PositionOutlier> outliers_;
    LowRank& matrix_;
    const double scale_;       // what integers in memory are multiples of
    std::vector<Vec3d> rest_;  // of each outlier, scene units
};

}  // namespace

void FloatException::add_rows(const PositionOutliers& outliers, uint32_t num_vertices,
                              uint64_t first, std::span<float> rows) const {
    for (const PositionOutlier& outlier : outliers.of_pose(pose)) {
        const Vec3d value = difference(outlier) / double{weight};
        for (uint64_t axis = 0; axis < 3; ++axis) {
            const uint64_t row = axis * num_vertices + outlier.vertex;
            if (row < first || row - first >= rows.size()) continue;
            rows[row - first] += static_cast<float>(value[static_cast<int>(axis)]);
        }
    }
}

std::vector<FloatException> float_exceptions(const PositionOutliers& outliers) {
    std::vector<FloatException> exceptions;
    for (const uint32_t pose : outliers.poses()) {
        double largest = 0.0;
        for (const PositionOutlier& outlier : outliers.of_pose(pose)) {
            largest = std::max(largest, difference(outlier).cwiseAbs().maxCoeff());
        }
        exceptions.push_back({pose, static_cast<float>(largest)});
    }
    return exceptions;
}

void append_weights(const std::vector<FloatException>& exceptions, LowRank& matrix) {
    for (const FloatException& exception : exceptions) {
        append_weight(exception.pose, exception.weight, false, matrix);
    }
}

void append_exceptions(const PositionOutliers& outliers, LowRank& matrix) {
    if (!matrix.holds_floats()) {
        for (const uint32_t pose : outliers.poses()) {
            IntegerExceptions(outliers.of_pose(pose), matrix).append();
        }
        return;
    }
    const std::vector<FloatException> exceptions = float_exceptions(outliers);
    for (const FloatException& exception : exceptions) {
        std::vector<float> rows(matrix.num_rows(), 0.0f);
        exception.add_rows(outliers, matrix.num_points, 0, rows);
        if (matrix.precision == Precision::f16) {
            for (float& value : rows) value = from_half(to_half(value));
        }
        matrix.components.emplace_back(std::move(rows));
    }
    append_weights(exceptions, matrix);
}

}  // namespace paim
