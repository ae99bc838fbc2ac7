// Predicts integers at vertices from those at vertices before them.
#include "paim/format/plane_predictor.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

PlanePredictor::PlanePredictor(const Topology& topology) : parents_(topology.num_vertices) {
    const auto add_parent = [&](uint32_t child, uint32_t parent) {
        if (parent >= child) return;
        Parents& parents = parents_[child];
        auto* const end = parents.vertex.begin() + parents.count;
        auto* const place = std::find_if(parents.vertex.begin(), end,
                                         [&](uint32_t other) { return other <= parent; });
        if (place != end && *place == parent) return;
        if (place == parents.vertex.end()) return;
        if (parents.count < kMaxParents) ++parents.count;
        std::move_backward(place, parents.vertex.begin() + parents.count - 1,
                           parents.vertex.begin() + parents.count);
        *place = parent;
    };
    for (const auto& [a, b, c] : topology.triangles) {
        add_parent(a, b);
        add_parent(a, c);
        add_parent(b, a);
        add_parent(b, c);
        add_parent(c, a);
        add_parent(c, b);
    }
}

PlanePredictor PlanePredictor::chain(size_t num_points) {
    PlanePredictor predictor;
    predictor.parents_.resize(num_points);
    for (size_t n = 1; n < num_points; ++n) {
        predictor.parents_[n].vertex[0] = static_cast<uint32_t>(n - 1);
        predictor.parents_[n].count = 1;
    }
    return predictor;
}

int32_t PlanePredictor::predict(Prediction prediction, size_t v, const int32_t* values) const {
    const Parents& parents = parents_[v];
    if (parents.count == 0) return 0;
    if (prediction == Prediction::latest) return values[parents.vertex[0]];
    int32_t sum = 0;
    for (uint32_t j = 0; j < parents.count; ++j) sum += values[parents.vertex[j]];
    // ⌊(2 · sum + count) / (2 · count)⌋, with the numerator made positive by a multiple of the
    // divisor.
    constexpr int32_t kPositive = 1 << 16;
    const auto count = static_cast<int32_t>(parents.count);
    return (2 * sum + count + kPositive * 2 * count) / (2 * count) - kPositive;
}

void PlanePredictor::subtract(Prediction prediction, std::span<const int32_t> values,
                              std::span<int32_t> residuals) const {
    PAIM_CHECK_EQ(values.size(), residuals.size());
    if (prediction == Prediction::none) {
        std::copy(values.begin(), values.end(), residuals.begin());
        return;
    }
    PAIM_CHECK_EQ(values.size(), parents_.size());
    for (size_t v = 0; v < values.size(); ++v) {
        residuals[v] = static_cast<int16_t>(values[v] - predict(prediction, v, values.data()));
    }
}

void PlanePredictor::add(Prediction prediction, std::span<int32_t> residuals) const {
    if (prediction == Prediction::none) return;
    PAIM_CHECK_EQ(residuals.size(), parents_.size());
    for (size_t v = 0; v < residuals.size(); ++v) {
        residuals[v] =
            static_cast<int16_t>(residuals[v] + predict(prediction, v, residuals.data()));
    }
}

}  // namespace paim
