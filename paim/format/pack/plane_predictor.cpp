// Predicts integers at vertices from those at vertices before them.
#include "paim/format/pack/plane_predictor.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

namespace {

using Parents = PlanePredictor::Parents;
using Parallelograms = PlanePredictor::Parallelograms;

// Into the four latest so far, which descend, without branches: whether a parent is a new one, and
// where it belongs, is as good as random.
void add_parent(Parents& parents, uint32_t row) {
    for (uint32_t& place : parents) {
        row = row == place ? 0 : row;
        const uint32_t later = std::max(place, row);
        row = std::min(place, row);
        place = later;
    }
}

// Of one to three parents, see Parents.
void repeat(Parents& parents) {
    if (parents[1] == 0) parents[1] = parents[0];
    if (parents[2] == 0) {
        parents[2] = parents[0];
        parents[3] = parents[1];
    }
    if (parents[3] == 0) parents[3] = parents[0];
}

// How many there are once they are repeated.
size_t num_distinct(const Parents& parents) {
    if (parents[0] == parents[1]) return parents[0] == 0 ? 0 : 1;
    if (parents[0] == parents[2]) return 2;
    return parents[0] == parents[3] ? 3 : 4;
}

bool contains(const Parents& parents, uint32_t row) {
    return (parents[0] == row) | (parents[1] == row) | (parents[2] == row) | (parents[3] == row);
}

// parents  [V] of all vertices, of which those of vertex v and of vertices before it are read
Parallelograms find_parallelograms(std::span<const Parents> parents, size_t v) {
    const Parents& mine = parents[v];
    Parallelograms found{{mine[0], 0, 0}, {mine[1], 0, 0}};
    size_t num_found = 0;
    const size_t num_mine = num_distinct(mine);
    for (size_t i = 0; i < num_mine; ++i) {
        const Parents& of_a = parents[mine[i] - 1];
        for (size_t j = i + 1; j < num_mine; ++j) {
            if (!contains(of_a, mine[j])) continue;
            // The latest parent of a that b touches too. Nobody (0) is no parent.
            const Parents& of_b = parents[mine[j] - 1];
            for (const uint32_t c : of_a) {
                const bool opposite = c > mine[j] ? contains(parents[c - 1], mine[j])
                                                  : c < mine[j] && c != 0 && contains(of_b, c);
                if (!opposite) continue;
                (num_found == 0 ? found.first : found.second) = {mine[i], mine[j], c};
                if (++num_found == 2) return found;
                break;
            }
        }
    }
    if (num_found == 1) found.second = found.first;
    return found;
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
        predictor.parents_[n].fill(static_cast<uint32_t>(n));
    }
    return predictor;
}

std::span<const Parallelograms> PlanePredictor::parallelograms() const {
    std::call_once(later_->made, [&] {
        later_->parallelograms.reserve(parents_.size());
        for (size_t v = 0; v < parents_.size(); ++v) {
            later_->parallelograms.push_back(find_parallelograms(parents_, v));
        }
    });
    return later_->parallelograms;
}

namespace {

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

// use(v, what it is predicted from)
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
void PlanePredictor::subtract(Prediction prediction, std::span<const Integer> values,
                              std::span<Integer> residuals) const {
    PAIM_CHECK_EQ(values.size(), residuals.size());
    if (prediction == Prediction::none) {
        std::copy(values.begin(), values.end(), residuals.begin());
        return;
    }
    for_each_point(*this, prediction, values.size(), [&](size_t v, const auto& from) {
        residuals[v] = static_cast<Integer>(values[v] - predict(from, values.data()));
    });
}

template <typename Integer>
void PlanePredictor::add(Prediction prediction, std::span<Integer> residuals) const {
    if (prediction == Prediction::none) return;
    for_each_point(*this, prediction, residuals.size(), [&](size_t v, const auto& from) {
        residuals[v] = static_cast<Integer>(residuals[v] + predict(from, residuals.data()));
    });
}

template void PlanePredictor::subtract(Prediction, std::span<const int8_t>,
                                       std::span<int8_t>) const;
template void PlanePredictor::subtract(Prediction, std::span<const int16_t>,
                                       std::span<int16_t>) const;
template void PlanePredictor::add(Prediction, std::span<int8_t>) const;
template void PlanePredictor::add(Prediction, std::span<int16_t>) const;

}  // namespace paim
