// Pieces of a mesh whose shape is judged by itself.
#include "paim/metrics/judged_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/median.h"
#include "paim/base/vector.h"
#include "paim/mesh/pieces.h"

namespace paim {

namespace {

// Fewer have hardly a shape.
constexpr std::ptrdiff_t kFewestVertices = 8;

bool is_a_twentieth(uint64_t num_vertices, uint64_t of_all) {
    return 20 * num_vertices >= of_all;
}

// Connected pieces, numbered from 1; 0 for all that are too small.
std::vector<uint32_t> large_pieces(const Topology& topology, size_t num_face_vertices) {
    const Pieces pieces = connected_pieces(topology);
    std::vector<uint32_t> number(pieces.count, 0);
    uint32_t count = 0;
    for (uint32_t j = 0; j < pieces.count; ++j) {
        const uint32_t size = pieces.num_vertices[j];
        const bool has_faces = size > 1;
        const bool is_large = size >= kSmallestPiece || is_a_twentieth(size, num_face_vertices);
        if (has_faces && is_large) number[j] = ++count;
    }
    std::vector<uint32_t> of_vertex(pieces.of_vertex.size());
    std::transform(pieces.of_vertex.begin(), pieces.of_vertex.end(), of_vertex.begin(),
                   [&](uint32_t j) { return number[j]; });
    return of_vertex;
}

// 0 within a factor of four of the median, and a step for each factor of sixteen.
int range_of(double length, double median) {
    if (!(length > 0.0 && median > 0.0)) return 0;
    return static_cast<int>(std::lround(0.25 * std::log2(length / median)));
}

}  // namespace

JudgedPieces judged_pieces(const Topology& topology, std::span<const uint32_t> face_vertices,
                           std::span<const double> edge_lengths) {
    PAIM_CHECK(edge_lengths.empty() || edge_lengths.size() == topology.num_vertices);
    const std::vector<uint32_t> piece = large_pieces(topology, face_vertices.size());
    const auto small_vertices = std::count_if(face_vertices.begin(), face_vertices.end(),
                                              [&](uint32_t v) { return piece[v] == 0; });
    std::map<uint32_t, std::vector<double>> lengths;
    for (const uint32_t v : face_vertices) {
        if (!edge_lengths.empty() && edge_lengths[v] > 0.0) {
            lengths[piece[v]].push_back(edge_lengths[v]);
        }
    }
    std::map<uint32_t, double> medians;
    for (auto& [j, of_piece] : lengths) medians[j] = median(std::move(of_piece));
    const auto key_of = [&](uint32_t v) {
        const double length = edge_lengths.empty() ? 0.0 : edge_lengths[v];
        return std::pair(piece[v], range_of(length, medians[piece[v]]));
    };
    std::map<std::pair<uint32_t, int>, uint64_t> sizes;
    for (const uint32_t v : face_vertices) ++sizes[key_of(v)];
    std::map<std::pair<uint32_t, int>, uint32_t> numbers;
    JudgedPieces judged{std::vector<uint32_t>(topology.num_vertices, JudgedPieces::kNone), 0};
    for (const uint32_t v : face_vertices) {
        auto key = key_of(v);
        if (key.first == 0 && small_vertices < kFewestVertices) continue;
        if (!is_a_twentieth(sizes[key], face_vertices.size())) key.second = 0;
        const auto [found, is_new] = numbers.emplace(key, judged.count);
        if (is_new) ++judged.count;
        judged.of_vertex[v] = found->second;
    }
    return judged;
}

std::vector<double> mean_edge_lengths(uint32_t num_vertices,
                                      std::span<const std::array<uint32_t, 2>> edges,
                                      std::span<const std::vector<float>> poses) {
    std::vector<double> sums(num_vertices, 0.0);
    std::vector<uint32_t> counts(num_vertices, 0);
    for (const std::vector<float>& planes : poses) {
        PAIM_CHECK_EQ(planes.size(), size_t{3} * num_vertices);
        const auto point = [&](uint32_t v) {
            return Vec3d(double{planes[v]}, double{planes[num_vertices + v]},
                         double{planes[2 * size_t{num_vertices} + v]});
        };
        for (const auto& [a, b] : edges) {
            const double length = (point(a) - point(b)).norm();
            for (const uint32_t v : {a, b}) {
                sums[v] += length;
                ++counts[v];
            }
        }
    }
    for (size_t v = 0; v < sums.size(); ++v) sums[v] /= std::max(1u, counts[v]);
    return sums;
}

}  // namespace paim
