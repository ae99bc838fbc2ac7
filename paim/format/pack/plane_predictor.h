// Predicts integers at vertices from those at vertices before them.
// Based on: Touma and Gotsman, Triangle Mesh Compression, 1998 (parallelograms)
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// How a value is predicted. Files contain these numbers.
enum class Prediction : uint8_t {
    none = 0,            // zero
    mean = 1,            // the mean over the latest neighbours, rounded to nearest, ties up
    parallelograms = 2,  // the mean of two neighbours' values, each plus its slope, ties up
};

// For each vertex, its neighbours among the vertices before it.
class PlanePredictor {
  public:
    static constexpr uint32_t kMaxParents = 4;
    static constexpr uint64_t kBytesAVertex = 40;

    // For points without a mesh: only Prediction::none is possible.
    PlanePredictor() = default;

    // Takes kBytesAVertex a vertex, part of it when parallelograms are first used.
    explicit PlanePredictor(const Topology& topology);

    // For points in a sequence, such as poses: the neighbour of each point is the one before it.
    static PlanePredictor chain(size_t num_points);

    // Rows of the vertices that a mean is over, latest first. A row is the vertex's number plus
    // one; row 0 stands for no vertex and has the value 0. A single parent is repeated four times,
    // two are repeated in turns, and of three the latest is repeated.
    using Parents = std::array<uint32_t, kMaxParents>;

    // Rows of two parallelograms: value a + b − c completes the triangle with corners a, b, c
    // across the edge a b. If the mesh has none, the prediction is the parent a (b = c = 0).
    struct Parallelograms {
        struct Corners {
            uint32_t a = 0, b = 0, c = 0;
        };
        Corners first, second;
    };

    static_assert(sizeof(Parents) + sizeof(Parallelograms) == kBytesAVertex);

    bool has_mesh() const { return !parents_.empty(); }
    std::span<const Parents> parents() const { return parents_; }

    // Computed when any thread first calls it.
    std::span<const Parallelograms> parallelograms() const;

  private:
    struct Later {
        std::once_flag made;
        std::vector<Parallelograms> parallelograms;
    };

    std::vector<Parents> parents_;  // [V], or none
    std::shared_ptr<Later> later_ = std::make_shared<Later>();
};

}  // namespace paim
