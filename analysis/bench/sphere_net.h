// Diffuse transfer as pbrt-v2 computes it: plain rays of one (0, 2)-sequence over the whole sphere.
// Based on: Pharr and Humphreys, Physically Based Rendering, second edition, 2010: Sample02() and
//           SHComputeDiffuseTransfer()
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/bench/bare_rays.h"

namespace paim::bench {

struct SphereNet {
    uint32_t bands = 5;
    uint32_t num_points =
        1024;  // on the sphere, a power of two as in pbrt; half are below horizons
    uint64_t seed = 1;
};

// The loop of pbrt, around Embree instead of its own tree, so that the loops differ and not the trees:
// for each point of the sequence, with a digital shift of the vertex's own, a direction; if it is above
// the horizon, one ray; if that is open, the basis, evaluated for it alone, and its sums.
// normals           [V] unit
// origins_per_piece  work is cut as in the baker, over as many threads
// returns           [planes][V]
std::vector<float> sphere_net_transfer(const BareScene& scene, std::span<const Vec3f> origins,
                                       std::span<const Vec3f> normals, const SphereNet& net,
                                       size_t origins_per_piece);

}  // namespace paim::bench
