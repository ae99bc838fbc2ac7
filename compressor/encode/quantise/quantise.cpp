// Components become integers, all with one step.
#include "compressor/encode/quantise/quantise.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "compressor/encode/quantise/largest_step.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Half of what would be rounded to ±1 costs more bits than its error is worth.
constexpr float kDeadZone = 0.6f;

// Points whose least squares are summed at once: few, so that they stay in the cache.
constexpr Index kPointsSummed = 512;

float plane_step(const Quantiser& quantiser, uint32_t plane) {
    return static_cast<float>(quantiser.step / std::sqrt(quantiser.plane_weight[plane]));
}

// To the nearest integer, of equals to the even one, as std::nearbyint() does for values below 2^22,
// which all are that fit in 16 bits; without a call, so that loops over values are vectors.
float nearest(float value) {
    constexpr float kNoFraction = 12582912.0f;  // 1.5 · 2^23: floats from here on are integers
    return (value + kNoFraction) - kNoFraction;
}

// In steps.
float round_mean(float value) {
    return nearest(value);
}
float round_component(float value) {
    return std::abs(value) < kDeadZone ? 0.0f : nearest(value);
}

// What rounding leaves of values, in squares of steps.
template <typename Round>
double left_by_rounding(std::span<const float> values, float step, Round&& round) {
    // Sums side by side, which vectors hold; as floats for so many values, then as doubles.
    constexpr size_t kSums = 8, kSummed = 1024;
    const float per_step = 1.0f / step;
    double sum = 0.0;
    size_t n = 0;
    while (n + kSums <= values.size()) {
        std::array<float, kSums> squares{};
        for (const size_t end = std::min(values.size(), n + kSummed); n + kSums <= end;
             n += kSums) {
            for (size_t i = 0; i < kSums; ++i) {
                const float value = values[n + i] * per_step;
                const float left = value - round(value);
                squares[i] += left * left;
            }
        }
        for (const float square : squares) sum += static_cast<double>(square);
    }
    for (; n < values.size(); ++n) {
        const float value = values[n] * per_step;
        const auto left = static_cast<double>(value - round(value));
        sum += left * left;
    }
    return sum;
}

// What the least squares need of the integers, Ĉ [rows][K], and the floats, [m − m̂, C]; rows are
// weighted.
struct Normal {
    MatrixXd gram;        // ĈᵀĈ [K][K]
    MatrixXd cross;       // Ĉᵀ [m − m̂, C] [K][1 + all components]
    double energy = 0.0;  // ‖m − m̂‖² + ‖C‖²

    void add(const Normal& other) {
        gram += other.gram;
        cross += other.cross;
        energy += other.energy;
    }
};

Normal normal_of_plane(const ScaledFactors& factors, const Quantiser& quantiser, uint32_t j) {
    const auto num_points = static_cast<Index>(factors.num_points);
    const auto all = static_cast<Index>(factors.num_components());
    const Index kept = std::min(all, static_cast<Index>(quantiser.num_components));
    const float step = plane_step(quantiser, j);
    Normal normal{MatrixXd::Zero(kept, kept), MatrixXd::Zero(kept, 1 + all), 0.0};
    MatrixXd exact, rounded;
    for (Index first = 0; first < num_points; first += kPointsSummed) {
        const Index count = std::min(kPointsSummed, num_points - first);
        const auto steps = [&](const std::vector<float>& values) {
            return Eigen::Map<const Eigen::VectorXf>(factors.plane(values, j).data() + first,
                                                     count) /
                   step;
        };
        exact.resize(count, 1 + all);
        rounded.resize(count, kept);
        const Eigen::VectorXf mean = steps(factors.mean);
        exact.col(0) = (mean - mean.unaryExpr(&round_mean)).cast<double>();
        for (Index k = 0; k < all; ++k) {
            const Eigen::VectorXf values = steps(factors.components[static_cast<size_t>(k)]);
            exact.col(1 + k) = values.cast<double>();
            if (k < kept) rounded.col(k) = values.unaryExpr(&round_component).cast<double>();
        }
        normal.gram.noalias() += rounded.transpose() * rounded;
        normal.cross.noalias() += rounded.transpose() * exact;
        normal.energy += exact.squaredNorm();
    }
    // From steps of this plane to weighted values: all planes have the same weighted step.
    return normal;
}

Normal normal_equations(const ScaledFactors& factors, const Quantiser& quantiser) {
    PAIM_CHECK_EQ(quantiser.plane_weight.size(), size_t{factors.num_planes});
    std::vector<Normal> planes(factors.num_planes);
    parallel_for(planes.size(), 1, [&](size_t j, size_t) {
        planes[j] = normal_of_plane(factors, quantiser, static_cast<uint32_t>(j));
    });
    Normal sum = std::move(planes[0]);
    for (size_t j = 1; j < planes.size(); ++j) sum.add(planes[j]);
    return sum;
}

// (ĈᵀĈ)⁻¹ Ĉᵀ [m − m̂, C], with zeros for components that are nothing but zero.
MatrixXd fit(const Normal& normal) {
    if (normal.gram.rows() == 0) return normal.cross;
    // Few integers are often multiples of each other, and what rounding then leaves of a pivot
    // would make weights of any size. This much more of every square is far above rounding and
    // costs less than 1e-10 of the energy.
    constexpr double kRidge = 1e-10;
    MatrixXd gram = normal.gram;
    for (Index k = 0; k < gram.rows(); ++k) {
        gram(k, k) = gram(k, k) == 0.0 ? 1.0 : (1.0 + kRidge) * gram(k, k);
    }
    return gram.ldlt().solve(normal.cross);
}

template <typename Integer>
std::vector<Integer> to_integers(const std::vector<float>& rounded) {
    std::vector<Integer> integers(rounded.size());
    std::transform(rounded.begin(), rounded.end(), integers.begin(),
                   [](float q) { return static_cast<Integer>(q); });
    return integers;
}

// Rounded to steps of each plane, in as few bits as hold them.
StoredValues store(const ScaledFactors& factors, const Quantiser& quantiser,
                   const std::vector<float>& values, float (*round)(float)) {
    std::vector<float> rounded(values.size());
    float largest = 0.0f;
    for (uint32_t j = 0; j < factors.num_planes; ++j) {
        const float step = plane_step(quantiser, j);
        const size_t first = size_t{j} * factors.num_points;
        for (size_t n = first; n < first + factors.num_points; ++n) {
            rounded[n] = round(values[n] / step);
            largest = std::max(largest, std::abs(rounded[n]));
        }
    }
    if (largest <= 127.0f) return to_integers<int8_t>(rounded);
    if (!(largest <= 32767.0f)) {
        throw_unsupported("values of {} steps do not fit in 16 bits: use --precision f32", largest);
    }
    return to_integers<int16_t>(rounded);
}

}  // namespace

LowRank quantise(const ScaledFactors& factors, const Quantiser& quantiser) {
    const Normal normal = normal_equations(factors, quantiser);
    const MatrixXd fitted = fit(normal);
    MatrixXd wide(1 + factors.weights.rows(), factors.weights.cols());
    wide << Eigen::RowVectorXd::Ones(factors.weights.cols()), factors.weights;
    const MatrixXd weights = fitted * wide;

    LowRank matrix;
    matrix.num_points = factors.num_points;
    matrix.num_planes = factors.num_planes;
    matrix.num_poses = factors.num_poses();
    matrix.singular_values = factors.singular_values;
    matrix.precision = Precision::i8;
    for (uint32_t j = 0; j < factors.num_planes; ++j) {
        matrix.steps.push_back(plane_step(quantiser, j));
    }
    matrix.mean = store(factors, quantiser, factors.mean, &round_mean);
    for (Index k = 0; k < weights.rows(); ++k) {
        if (normal.gram(k, k) == 0.0) continue;
        // A value of a component errs in every pose, by weights of unit RMS; a weight in every row.
        const double alike = std::sqrt(static_cast<double>(weights.cols()) / normal.gram(k, k));
        const double largest = weights.row(k).cwiseAbs().maxCoeff();
        if (std::nearbyint(largest / alike) == 0.0) continue;
        const double step = std::max(alike, largest / 32767.0);
        matrix.components.push_back(store(
            factors, quantiser, factors.components[static_cast<size_t>(k)], &round_component));
        matrix.singular_indices.push_back(static_cast<uint32_t>(k));
        if (!matrix.components.back().holds_i8()) matrix.precision = Precision::i16;
        matrix.weight_steps.push_back(static_cast<float>(step));
        for (Index p = 0; p < weights.cols(); ++p) {
            const double q = std::nearbyint(weights(k, p) / matrix.weight_steps.back());
            matrix.weights.push_back(static_cast<float>(std::clamp(q, -32767.0, 32767.0)) *
                                     matrix.weight_steps.back());
        }
    }
    matrix.num_components = static_cast<uint32_t>(matrix.components.size());
    // The first ones need no names.
    if (matrix.num_components == 0 || matrix.singular_indices.back() + 1 == matrix.num_components) {
        matrix.singular_indices.clear();
    }
    return matrix;
}

double quantised_error(const ScaledFactors& factors, const Quantiser& quantiser) {
    const Normal normal = normal_equations(factors, quantiser);
    const double explained = fit(normal).cwiseProduct(normal.cross).sum();
    const double in_steps = std::max(0.0, normal.energy - explained);
    return quantiser.step * quantiser.step * factors.num_poses() * in_steps;
}

double rounding_error(const ScaledFactors& factors, const Quantiser& quantiser) {
    std::vector<double> planes(factors.num_planes);
    parallel_for(planes.size(), 1, [&](size_t j, size_t) {
        const auto plane = static_cast<uint32_t>(j);
        const float step = plane_step(quantiser, plane);
        planes[j] = left_by_rounding(factors.plane(factors.mean, plane), step, round_mean);
        for (uint32_t k = 0; k < factors.num_components(); ++k) {
            const auto values = factors.plane(factors.components[k], plane);
            planes[j] += k < quantiser.num_components
                             ? left_by_rounding(values, step, round_component)
                             : left_by_rounding(values, step, [](float) { return 0.0f; });
        }
    });
    double sum = 0.0;
    for (const double plane : planes) sum += plane;
    return quantiser.step * quantiser.step * factors.num_poses() * sum;
}

uint64_t least_squares_bytes(uint64_t num_planes, uint64_t num_components, uint64_t num_threads) {
    const uint64_t columns = 2 * num_components + 2;
    // The sum, its copy with the ridge, the decomposition and the solution.
    constexpr uint64_t kSolving = 4;
    return ((num_planes + kSolving) * num_components * columns +
            num_threads * static_cast<uint64_t>(kPointsSummed) * (columns + 1)) *
           sizeof(double);
}

double smallest_step(const ScaledFactors& factors, const Quantiser& quantiser,
                     Precision precision) {
    double largest = 0.0;
    const auto extend = [&](const std::vector<float>& values) {
        for (uint32_t j = 0; j < factors.num_planes; ++j) {
            const double weight = std::sqrt(quantiser.plane_weight[j]);
            for (const float value : factors.plane(values, j)) {
                largest = std::max(largest, std::abs(value) * weight);
            }
        }
    };
    extend(factors.mean);
    const uint32_t kept = std::min(quantiser.num_components, factors.num_components());
    for (uint32_t k = 0; k < kept; ++k) extend(factors.components[k]);
    // A little more, as the quotient is rounded.
    return 1.0001 * largest / largest_integer(precision);
}

double largest_step(const ScaledFactors& factors, Quantiser quantiser, double most) {
    const auto with_step = [&](double step) -> const Quantiser& {
        quantiser.step = step;
        return quantiser;
    };
    return largest_step(
        smallest_step(factors, quantiser, Precision::i16), most,
        [&](double step) { return rounding_error(factors, with_step(step)); },
        [&](double step) { return quantised_error(factors, with_step(step)); });
}

}  // namespace paim
