// Outliers as components of their own, so that they cost the other vertices and poses nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/low_rank.h"
#include "paim/mesh/outliers.h"

namespace paim {

// An exception (LowRank::num_usual_components()) of floats: what it holds of the outliers of a pose
// is (position − usual) / weight, at most 1.
struct FloatException {
    uint32_t pose = 0;
    float weight = 0.0f;

    // Adds the values of rows [first, first + rows.size()) of the component.
    void add_rows(const PositionOutliers& outliers, uint32_t num_vertices, uint64_t first,
                  std::span<float> rows) const;
};

// Outliers are stored no farther from the origin of coordinates than this, scene units, so that sums
// of a file's values stay finite floats whatever their number.
constexpr float kFarthestOutlier = 1e32f;

// One for each pose that has outliers, by pose.
std::vector<FloatException> float_exceptions(const PositionOutliers& outliers);

// Appends the exceptions' weights and singular values to a matrix whose components are streamed.
void append_weights(const std::vector<FloatException>& exceptions, LowRank& matrix);

// Appends whole exceptions to a matrix of positions, floats or integers, smoothed or not. Without
// outliers the matrix stays as it is.
//
// Integers of an exception are as large as 16 bits allow, and its weight makes up for the rest. What
// this leaves of the outliers is a second exception, where it is more than the step of the other
// components. So an outlier errs by half a step, or by less than 1e-6 of its distance if that is
// more. If it is farther than about 1e37 steps, it is moved nearer.
void append_exceptions(const PositionOutliers& outliers, LowRank& matrix);

}  // namespace paim
