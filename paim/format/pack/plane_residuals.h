// Values of a plane as what their prediction leaves, and the slow way back.
#pragma once

#include <span>

#include "paim/format/pack/plane_predictor.h"

namespace paim {

// residuals[n] = values[n] − prediction, in arithmetic of the integers' size that wraps around, as
// do the sums that predictions are made of.
// values, residuals  [N] of the predictor's points
template <typename Integer>
void subtract_prediction(const PlanePredictor& predictor, Prediction prediction,
                         std::span<const Integer> values, std::span<Integer> residuals);

// The reverse, in place, one plane after the other: the reference for reconstruct_planes(), which
// does many at once.
template <typename Integer>
void add_prediction(const PlanePredictor& predictor, Prediction prediction,
                    std::span<Integer> residuals);

}  // namespace paim
