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

// What a value is predicted to be. Files hold these numbers.
enum class Prediction : uint8_t {
    none = 0,            // zero
    mean = 1,            // the mean over the latest neighbours, rounded to nearest, ties up
    parallelograms = 2,  // the mean of two neighbours' values, each plus its slope, ties up
};

// Neighbours of vertices among those before them.
class PlanePredictor {
  public:
    static constexpr uint32_t kMaxParents = 4;
    static constexpr uint64_t kBytesAVertex = 40;

    // For points that are no mesh: only Prediction::none.
    PlanePredictor() = default;

    // Takes kBytesAVertex, in part later.
    explicit PlanePredictor(const Topology& topology);

    // For points in a row, such as poses: the neighbour of each is the one before.
    static PlanePredictor chain(size_t num_points);

    // Rows of what a mean is over, the latest first: one more than the vertex, 0 for nobody, whose
    // value is 0. One parent is there four times, two twice in turns, the latest of three twice.
    using Parents = std::array<uint32_t, kMaxParents>;

    // Rows of two parallelograms: value a + b − c completes the triangle with corners a, b, c across
    // the edge a b. Where the mesh has none, a parent stands for it (b = c = 0).
    struct Parallelograms {
        struct Corners {
            uint32_t a = 0, b = 0, c = 0;
        };
        Corners first, second;
    };

    static_assert(sizeof(Parents) + sizeof(Parallelograms) == kBytesAVertex);

    bool has_mesh() const { return !parents_.empty(); }
    std::span<const Parents> parents() const { return parents_; }

    // Made when they are first asked for, by any thread.
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
