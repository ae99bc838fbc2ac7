// Predicts integers at vertices from those at vertices before them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// What a value is predicted to be. Files hold these numbers.
enum class Prediction : uint8_t {
    none = 0,    // zero
    latest = 1,  // the value at the latest neighbour
    mean = 2,    // the mean over the latest neighbours, rounded to nearest, halves up
};

// Neighbours of vertices among those before them.
class PlanePredictor {
  public:
    static constexpr uint32_t kMaxParents = 4;

    // For points that are no mesh: only Prediction::none.
    PlanePredictor() = default;

    explicit PlanePredictor(const Topology& topology);

    // For points in a row, such as poses: the neighbour of each is the one before.
    static PlanePredictor chain(size_t num_points);

    // The latest first: one more than the vertex, 0 for nobody. A mean is over four, or over three
    // and nobody: one parent is there four times, two twice in turns, which has the same mean.
    struct Parents {
        std::array<uint32_t, kMaxParents> row;
        bool has_three() const { return row[3] == 0; }
    };

    bool has_mesh() const { return !parents_.empty(); }
    std::span<const Parents> parents() const { return parents_; }

    // residuals[n] = values[n] − prediction, wrapped around to 16 bits, as values are
    void subtract(Prediction prediction, std::span<const int32_t> values,
                  std::span<int32_t> residuals) const;

    // The reverse, in place: whatever the residuals, values of 16 bits.
    void add(Prediction prediction, std::span<int32_t> residuals) const;

  private:
    int32_t predict(Prediction prediction, size_t v, const int32_t* values) const;

    std::vector<Parents> parents_;  // [V], or none
};

}  // namespace paim
