// Residuals of values against their prediction, and the slow reference of the inverse.
#pragma once

#include <span>

#include "paim/format/pack/plane_predictor.h"

namespace paim {

// residuals[n] = values[n] − prediction. Arithmetic, also in predictions, wraps around at the size
// of the integers.
// values, residuals  [N] of the predictor's points
template <typename Integer>
void subtract_prediction(const PlanePredictor& predictor, Prediction prediction,
                         std::span<const Integer> values, std::span<Integer> residuals);

// The inverse, in place, one plane after another. It is the reference for reconstruct_planes(),
// which reconstructs many planes at once.
template <typename Integer>
void add_prediction(const PlanePredictor& predictor, Prediction prediction,
                    std::span<Integer> residuals);

}  // namespace paim
