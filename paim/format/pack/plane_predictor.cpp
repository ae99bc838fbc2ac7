// Predicts integers at vertices from those at vertices before them.
#include "paim/format/pack/plane_predictor.h"

#include <algorithm>

namespace paim {

namespace {

using Parents = PlanePredictor::Parents;
using Parallelograms = PlanePredictor::Parallelograms;

// Inserts a row into the four latest ones, in descending order. It has no branches, because whether
// and where a row belongs there is practically random.
void add_parent(Parents& parents, uint32_t row) {
    for (uint32_t& place : parents) {
        row = row == place ? 0 : row;
        const uint32_t later = std::max(place, row);
        row = std::min(place, row);
        place = later;
    }
}

// Repeats one to three parents, as described at Parents.
void repeat(Parents& parents) {
    if (parents[1] == 0) parents[1] = parents[0];
    if (parents[2] == 0) {
        parents[2] = parents[0];
        parents[3] = parents[1];
    }
    if (parents[3] == 0) parents[3] = parents[0];
}

// Number of different parents, after repeat().
size_t num_distinct(const Parents& parents) {
    if (parents[0] == parents[1]) return parents[0] == 0 ? 0 : 1;
    if (parents[0] == parents[2]) return 2;
    return parents[0] == parents[3] ? 3 : 4;
}

bool contains(const Parents& parents, uint32_t row) {
    return (parents[0] == row) | (parents[1] == row) | (parents[2] == row) | (parents[3] == row);
}

// The parallelograms of vertex v.
// parents  [V] of all vertices; those of v and of vertices before it are read
Parallelograms find_parallelograms(std::span<const Parents> parents, size_t v) {
    const Parents& mine = parents[v];
    Parallelograms found{{mine[0], 0, 0}, {mine[1], 0, 0}};
    size_t num_found = 0;
    const size_t num_mine = num_distinct(mine);
    for (size_t i = 0; i < num_mine; ++i) {
        const Parents& of_a = parents[mine[i] - 1];
        for (size_t j = i + 1; j < num_mine; ++j) {
            if (!contains(of_a, mine[j])) continue;
            // The latest parent of a that is also a neighbour of b. Row 0 is no parent.
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

}  // namespace paim
