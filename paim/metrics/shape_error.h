// How much decoding changes the shape of a surface where one looks: edges and face normals.
// Based on: Vasa and Skala, A Perception Correlated Comparison Method for Dynamic Meshes, 2011
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/pieces.h"
#include "paim/mesh/topology.h"

namespace paim {

// Of one surface over all poses.
struct ShapeError {
    double sted_space = 0.0;        // mean local deviation of relative edge differences
    double sted_time = 0.0;         // the same of edges from a pose to the next
    double normal_angle_deg = 0.0;  // mean angle between baked and decoded face normals

    double sted() const;  // √(space² + time²)
};

// The whole, and the piece of the mesh that has the largest of each error.
struct PieceShapeError {
    ShapeError whole;
    ShapeError worst;
};

// Errors of surfaces, pose by pose. A mesh is judged as a whole, and each connected piece of it by
// itself, so that a large piece does not hide what happens to a small one.
//
// Space. An edge of baked length l and decoded length l' has the relative difference |l − l'| / l.
// The deviation of a vertex is the standard deviation of this difference over its edges, each
// weighted by l: it is zero where a neighbourhood is only scaled. Time. The position of a vertex
// and the time are four coordinates, a pose being as far from the next as a hundredth of the
// diagonal. The deviation is that of the two edges which meet at a pose. STED is the root of both
// mean squares. Edges without length are left out, and so are faces without area.
class ShapeErrorMeter {
  public:
    explicit ShapeErrorMeter(const Topology& topology);

    // Adds the next pose.
    // positions, reference  [3][V] planes x, y, z
    void add(std::span<const float> positions, std::span<const float> reference);

    PieceShapeError result() const;

    static uint64_t bytes(uint64_t num_vertices, uint64_t num_triangles);

  private:
    struct Sums {
        double space = 0.0, time = 0.0, angle = 0.0;
        uint64_t num_space = 0, num_time = 0, num_angles = 0;

        void add(const Sums& other);
        ShapeError mean() const;
    };
    // A vertex's edge from a pose to the next.
    struct Step {
        float length = 0.0f, difference = 0.0f;
    };

    void add_edges(std::span<const float> positions, std::span<const float> reference);
    void add_steps(std::span<const float> positions, std::span<const float> reference);
    void add_normals(std::span<const float> positions, std::span<const float> reference);

    const Topology& topology_;
    Pieces pieces_;
    std::vector<uint32_t> face_vertices_;
    std::vector<std::array<uint32_t, 2>> edges_;
    std::vector<Sums> sums_;                    // [pieces]
    std::vector<float> positions_, reference_;  // of the pose before; empty before the first
    std::vector<Step> steps_;  // that led to the pose before; empty before the second
};

// Pieces of fewer vertices than this, and than a twentieth of all, are not judged by themselves.
constexpr uint32_t kSmallestPiece = 100;

}  // namespace paim
