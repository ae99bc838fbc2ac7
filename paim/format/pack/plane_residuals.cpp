// Residuals of values against their prediction, and the slow reference of the inverse.
#include "paim/format/pack/plane_residuals.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

namespace {

using Parents = PlanePredictor::Parents;
using Parallelograms = PlanePredictor::Parallelograms;

template <typename Integer>
int32_t at(const Integer* values, uint32_t row) {
    return row == 0 ? 0 : values[row - 1];
}

template <typename Integer>
int32_t predict(const Parents& parents, const Integer* values) {
    int32_t sum = 0;
    for (const uint32_t row : parents) sum += at(values, row);
    return (sum + 2) >> 2;
}

template <typename Integer>
int32_t complete(const Parallelograms::Corners& corners, const Integer* values) {
    return static_cast<Integer>(at(values, corners.a) + at(values, corners.b) -
                                at(values, corners.c));
}

template <typename Integer>
int32_t predict(const Parallelograms& two, const Integer* values) {
    return (complete(two.first, values) + complete(two.second, values) + 1) >> 1;
}

// Calls use(v, prediction of v) for every vertex in order.
template <typename Use>
void for_each_point(const PlanePredictor& predictor, Prediction prediction, size_t num_points,
                    const Use& use) {
    PAIM_CHECK_EQ(num_points, predictor.parents().size());
    if (prediction == Prediction::mean) {
        for (size_t v = 0; v < num_points; ++v) use(v, predictor.parents()[v]);
    } else {
        const std::span<const Parallelograms> all = predictor.parallelograms();
        for (size_t v = 0; v < num_points; ++v) use(v, all[v]);
    }
}

}  // namespace

template <typename Integer>
void subtract_prediction(const PlanePredictor& predictor, Prediction prediction,
                         std::span<const Integer> values, std::span<Integer> residuals) {
    PAIM_CHECK_EQ(values.size(), residuals.size());
    if (prediction == Prediction::none) {
        std::copy(values.begin(), values.end(), residuals.begin());
        return;
    }
    for_each_point(predictor, prediction, values.size(), [&](size_t v, const auto& from) {
        residuals[v] = static_cast<Integer>(values[v] - predict(from, values.data()));
    });
}

template <typename Integer>
void add_prediction(const PlanePredictor& predictor, Prediction prediction,
                    std::span<Integer> residuals) {
    if (prediction == Prediction::none) return;
    for_each_point(predictor, prediction, residuals.size(), [&](size_t v, const auto& from) {
        residuals[v] = static_cast<Integer>(residuals[v] + predict(from, residuals.data()));
    });
}

template void subtract_prediction(const PlanePredictor&, Prediction, std::span<const int8_t>,
                                  std::span<int8_t>);
template void subtract_prediction(const PlanePredictor&, Prediction, std::span<const int16_t>,
                                  std::span<int16_t>);
template void add_prediction(const PlanePredictor&, Prediction, std::span<int8_t>);
template void add_prediction(const PlanePredictor&, Prediction, std::span<int16_t>);

}  // namespace paim
