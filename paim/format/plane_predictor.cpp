// Predicts integers at vertices from those at vertices before them.
#include "paim/format/plane_predictor.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

namespace {

using Parents = PlanePredictor::Parents;

// Into the four latest so far, which descend, without branches: whether a parent is a new one, and
// where it belongs, is as good as random.
void add_parent(Parents& parents, uint32_t row) {
    for (uint32_t& place : parents.row) {
        row = row == place ? 0 : row;
        const uint32_t later = std::max(place, row);
        row = std::min(place, row);
        place = later;
    }
}

// Of one or two parents, see Parents.
void repeat(Parents& parents) {
    auto& row = parents.row;
    if (row[2] != 0) return;
    if (row[1] == 0) row[1] = row[0];
    row[2] = row[0];
    row[3] = row[1];
}

}  // namespace

PlanePredictor::PlanePredictor(const Topology& topology) : parents_(topology.num_vertices) {
    const auto add_edge = [&](uint32_t a, uint32_t b) {
        const uint32_t parent = std::min(a, b);
        const uint32_t child = std::max(a, b);
        add_parent(parents_[child], parent == child ? 0 : parent + 1);
    };
    for (const auto& [a, b, c] : topology.triangles) {
        add_edge(a, b);
        add_edge(b, c);
        add_edge(c, a);
    }
    for (Parents& parents : parents_) repeat(parents);
}

PlanePredictor PlanePredictor::chain(size_t num_points) {
    PlanePredictor predictor;
    predictor.parents_.resize(num_points);
    for (size_t n = 1; n < num_points; ++n) {
        predictor.parents_[n].row[0] = static_cast<uint32_t>(n);
        repeat(predictor.parents_[n]);
    }
    return predictor;
}

int32_t PlanePredictor::predict(Prediction prediction, size_t v, const int32_t* values) const {
    const Parents& parents = parents_[v];
    const auto at = [&](uint32_t row) { return row == 0 ? 0 : values[row - 1]; };
    if (prediction == Prediction::latest) return at(parents.row[0]);
    int32_t sum = 0;
    for (const uint32_t row : parents.row) sum += at(row);
    // ⌊(2 · sum + count) / (2 · count)⌋, with the numerator made positive by a multiple of the
    // divisor.
    constexpr int32_t kPositive = 1 << 16;
    const int32_t count = parents.has_three() ? 3 : 4;
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
