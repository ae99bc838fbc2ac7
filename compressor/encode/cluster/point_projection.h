// Points in few dimensions that keep their distances, for clustering.
// Based on: Halko, Martinsson and Tropp, Finding Structure with Randomness: Probabilistic
//           Algorithms for Constructing Approximate Matrix Decompositions, 2011
#pragma once

#include "compressor/encode/data/point_source.h"

namespace paim {

// The points' coordinates along their first `num_dimensions` principal directions, about their
// common mean; a column a point, [d][V] with d at most num_dimensions and what the points have.
// A random projection of a quarter more columns finds the directions (one pass over the planes);
// the points are measured along them in a second. Deterministic; seed keys the random projection.
Eigen::MatrixXf project_points(const PointSource& points, uint32_t num_dimensions, uint64_t seed);

// Columns of the random projection for so many dimensions of so many.
uint64_t sketch_columns(uint64_t num_dimensions, uint64_t of);

// Memory of project_points(): a plane; the sketch, twice while it is narrowed; its Gram matrix in
// parts; and on each thread a block of points that is mapped.
uint64_t projection_scratch_bytes(const PointSource& points, uint64_t num_dimensions,
                                  uint64_t num_threads);

// Points that are worked on together, here and where they are assigned.
constexpr size_t kPointsAtOnce = 256;

}  // namespace paim
