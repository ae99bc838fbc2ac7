// What decides how a pose is baked.
#pragma once

#include <cstdint>

#include "compressor/bake/direction_sampler.h"

namespace paim {

// Whether poses share their random numbers.
enum class Streams : uint32_t {
    per_pose,  // independent in every pose: noise averages out over the poses, but flickers
    shared,    // the same in every pose: noise moves with the mesh, and stays
    mixed,     // one half of the rays shared, one per pose
};

// What options and manifests call it: "per-pose", "shared" or "mixed".
const char* streams_name(Streams streams);

constexpr Streams kStreams[] = {Streams::per_pose, Streams::shared, Streams::mixed};

struct BakeOptions {
    uint32_t bands = 5;   // 1 … sh::kMaxBands
    uint32_t rays = 512;  // per vertex, even, 2 … 2^24; with a transfer_error, the most
    uint64_t seed = 1;
    // Above 0: each vertex is baked until the estimated error of its transfer (noise_target.h), as a
    // fraction of the transfer of an open vertex, is at most this.
    double transfer_error = 0.0;
    SamplerKind sampler = SamplerKind::cosine;
    Streams streams = Streams::per_pose;
    uint32_t bounces = 0;  // of light between vertices, 0 … kMaxBounces (bounces.h)
};

// The key of the rays of one half (0 or 1) of a vertex.
uint64_t half_key(const BakeOptions& options, uint32_t p, uint32_t v, uint32_t half);

// The L2 norm of the transfer of an open vertex, whichever way it faces:
// √(Σ_l (â_l/π)² (2l+1)/4π) over the bands.
double open_transfer_norm(uint32_t bands);

}  // namespace paim
