// Integers of a surface, smoothed within their rounding.
//
// A stored integer q stands for any number from q − ½ to q + ½. Where a plane is smooth over the
// mesh, the mean of a vertex's neighbours says more about where in this range the number was. So the
// errors of rounding become smaller and smoother, for no bytes in the file but a number of rounds.
// Based on: Zakhor, Iterative Procedures for Reduction of Blocking Effects in Transform Image
//           Coding, 1992 (smoothing, then projection onto what was quantised)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/low_rank.h"
#include "paim/codec/vector_unit.h"
#include "paim/mesh/topology.h"

namespace paim {

// The most rounds of smoothing of a plane.
constexpr uint32_t kMaxSmoothingRounds = 8;

class SurfaceSmoother {
  public:
    // Neighbours of a vertex are the other corners of its triangles. A vertex that n triangles share
    // with it counts n times.
    explicit SurfaceSmoother(const Topology& topology);

    // Moves each value half of the way to the mean of its neighbours, `rounds` times, but never
    // farther than `reach` from what is stored. The same bytes on any machine.
    // stored  [V] integers
    // values  [V] in: the same, or smoothed by earlier rounds
    void smooth(std::span<const float> stored, uint32_t rounds, float reach,
                std::span<float> values) const;

    // Neighbours of vertex v are numbers first()[v] to first()[v + 1] − 1 of neighbours().
    std::span<const uint32_t> first() const { return first_; }  // [V + 1]
    std::span<const uint32_t> neighbours() const { return neighbours_; }

    static uint64_t bytes(uint64_t num_vertices, uint64_t num_triangles);

  private:
    std::vector<uint32_t> first_;
    std::vector<uint32_t> neighbours_;  // [6 F]
};

// Half of the range that a value of so many fraction bits may be moved in, so that it is still
// rounded to the integer that it was.
constexpr float smoothing_reach(uint32_t fraction_bits) {
    return 0.5f - 1.0f / static_cast<float>(1u << fraction_bits);
}

// The most fraction bits, at most 4, with which all of these integers fit into 16 bits; 0 if fewer
// than 2 do.
uint32_t smoothing_fraction_bits(const LowRank& matrix);

// Smooths a matrix as it was stored: mean and components become multiples of 2^-fraction_bits of
// the step, and steps that much finer. Values of 8 bits then take 16.
// matrix    of integers; in: fraction_bits and smoothing are set, values and steps as stored
// smoother  of the mesh whose vertices are the points
void smooth_stored(LowRank& matrix, const SurfaceSmoother& smoother,
                   VectorUnit unit = best_vector_unit());
void smooth_stored(LowRank& matrix, const Topology& topology);

// The integers that smoothing started from.
StoredValues stored_integers(const StoredValues& smoothed, uint32_t fraction_bits);

}  // namespace paim
