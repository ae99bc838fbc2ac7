// Still parts as low-rank matrices, and removal of components.
#include "paim/codec/low_rank.h"

#include <algorithm>
#include <utility>

#include "paim/base/check.h"

namespace paim {

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

}  // namespace paim
