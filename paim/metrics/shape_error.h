// How much decoding changes the shape of a surface where one looks: edges and face normals.
// Based on: Vasa and Skala, A Perception Correlated Comparison Method for Dynamic Meshes, 2011
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"
#include "paim/metrics/judged_pieces.h"

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

// What the shape of a mesh is judged by. It is made once for a mesh.
struct ShapeNeighbours {
    // poses  [3][V] each: planes x, y and z of some, which say how long edges are; none: pieces are
    //        not told apart by that (judged_pieces.h)
    explicit ShapeNeighbours(const Topology& topology,
                             std::span<const std::vector<float>> poses = {});

    static uint64_t bytes(uint64_t num_vertices, uint64_t num_triangles);

    uint32_t num_vertices = 0;
    std::vector<Triangle> triangles;
    std::vector<std::array<uint32_t, 2>> edges;  // each once
    std::vector<uint32_t> face_vertices;         // ascending
    JudgedPieces judged;
};

// Errors of surfaces, pose by pose. A mesh is judged as a whole, and each of its pieces by itself
// (judged_pieces.h).
//
// Space. An edge of baked length l and decoded length l' has the relative difference |l − l'| / l.
// The deviation of a vertex is the standard deviation of this difference over its edges, each
// weighted by l: it is zero where a neighbourhood is only scaled. Time. The position of a vertex
// and the time are four coordinates, a pose being as far from the next as a hundredth of the
// diagonal. The deviation is that of the two edges which meet at a pose. STED is the root of both
// mean squares. Edges without length are left out, and so are faces without area.
class ShapeErrorMeter {
  public:
    // Keeps a reference.
    explicit ShapeErrorMeter(const ShapeNeighbours& mesh) : mesh_(mesh) {
        sums_.resize(size_t{mesh.judged.count} + 1);
    }

    // A pose, decoded and baked: planes x, y, z. [3][V]
    struct Pose {
        std::vector<float> positions, reference;
    };

    // Adds the next poses, all at once. How they are cut into calls does not change the result, nor
    // does the number of threads.
    void add(std::span<const Pose> poses);

    PieceShapeError result() const;

    // Memory in addition to the mesh and the poses that are added at once.
    static uint64_t bytes(uint64_t num_vertices, uint64_t num_poses_at_once);

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
    // Sums by the piece that they are judged with; last those of vertices in no such piece.
    using PieceSums = std::vector<Sums>;

    Sums& sums_of(uint32_t vertex, PieceSums& sums) const {
        return sums[std::min(mesh_.judged.of_vertex[vertex], mesh_.judged.count)];
    }
    void add_edges(const Pose& pose, PieceSums& sums) const;
    void add_normals(const Pose& pose, PieceSums& sums) const;
    std::vector<Step> steps(const Pose& before, const Pose& pose) const;
    void add_steps(const std::vector<Step>& before, const std::vector<Step>& steps,
                   PieceSums& sums) const;

    const ShapeNeighbours& mesh_;
    PieceSums sums_;
    Pose last_;                     // the pose before; empty before the first
    std::vector<Step> last_steps_;  // that led to the pose before; empty before the second
};

}  // namespace paim
