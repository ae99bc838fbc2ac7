// Whether bakes of few rays are off from one of many rays by more than chance.
#pragma once

#include <cstdint>

#include "compressor/bake/direction_sampler.h"
#include "paim/mesh/pose_source.h"

namespace paim {

constexpr uint32_t kReferenceRays = 65536;

// The largest of 50 z-values of pose 0 at 5 bands: sums of errors over vertices and seeds,
// coefficient by coefficient, in units of their standard errors as the bakes know them. Half of the
// sums are plain, half weighted by the reference, in which shadows that are too dark or too light
// would show.
double largest_z(const PoseSource& source, SamplerKind sampler, uint32_t rays, int num_seeds);

// Of 50 normal numbers one is beyond 4.5 once in 3000 times; sums over thousands of vertices are
// close to normal. A bias of a tenth of the noise of one vertex would give
// √(vertices · seeds) / 10: 12 for 16,000.
constexpr double kLargestZ = 4.5;

}  // namespace paim
