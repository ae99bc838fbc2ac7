// Pieces of a mesh whose shape is judged by itself, so that what is large does not hide what is small.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Pieces of fewer vertices than this, and than a twentieth of all that have a face, are judged
// together.
constexpr uint32_t kSmallestPiece = 100;

struct JudgedPieces {
    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> of_vertex;  // [V] below `count`; kNone: judged with the whole mesh alone
    uint32_t count = 0;
};

// First, each connected piece is one, and all that are too small are one together, if they have at least
// 8 vertices. Then vertices of such a piece are told apart by the mean length of their edges: what is
// within a factor of four of the median stays together, and so does each range of a factor of sixteen
// above and below. So a fine figure is judged apart from a coarse ground that it is connected to.
// Ranges of less than a twentieth of all vertices that have a face stay with the median's, so that
// small details of a body, such as its nostrils, do not decide.
// edge_lengths  [V] of a vertex's edges, scene units; 0: unknown, or none. Empty: all are alike
JudgedPieces judged_pieces(const Topology& topology, std::span<const uint32_t> face_vertices,
                           std::span<const double> edge_lengths);

// [V] The mean length of the edges of each vertex in these poses, 0 if they have none.
// poses  [3][V] each: planes x, y and z
std::vector<double> mean_edge_lengths(uint32_t num_vertices,
                                      std::span<const std::array<uint32_t, 2>> edges,
                                      std::span<const std::vector<float>> poses);

}  // namespace paim
