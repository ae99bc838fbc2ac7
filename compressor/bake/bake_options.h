// Options of the baker.
#pragma once

#include <cstdint>

#include "compressor/bake/direction_sampler.h"
#include "paim/transfer/layout.h"

namespace paim {

// Whether poses share their random numbers (--pose-noise).
enum class Streams : uint32_t {
    per_pose,  // independent in every pose: the noise averages out over the poses, but flickers
    shared,    // the same in every pose: the noise moves with the mesh and does not average out
    mixed,     // half of the rays shared by all poses, the other half independent of them
};

// The name in manifests: "per-pose", "shared" or "mixed".
const char* streams_name(Streams streams);

constexpr Streams kStreams[] = {Streams::per_pose, Streams::shared, Streams::mixed};

// The most rays of a vertex.
constexpr uint32_t kMostRays = 1u << 24;

struct BakeOptions {
    uint32_t bands = 5;  // 1 … sh::kMaxBands
    // Per vertex, even, 2 … kMostRays; the limit if there is a transfer_error.
    uint32_t rays = 512;
    uint64_t seed = 1;
    // The noise target, if above 0: rays are traced at each vertex until the estimated error of its
    // transfer (noise_target.h) is at most this fraction of the transfer of an unshadowed vertex.
    double transfer_error = 0.0;
    SamplerKind sampler = SamplerKind::cosine;
    Streams streams = Streams::per_pose;
    // Of glossy transfer; 0: as many as the materials need (material/gloss_bands.h).
    uint32_t gloss_in_bands = 0;   // of light, 1 … sh::kMaxBands
    uint32_t gloss_out_bands = 0;  // of outgoing radiance, 1 … kMaxOutBands
    uint32_t bounces = 0;  // number of times that light bounces, 0 … kMaxBounces (bake_directory.h)
};

// How the halves of the rays of a vertex go together: independent if only one of them is shared.
HalfRelation half_relation(const BakeOptions& options);

// Keys of the random numbers of a round (0, 1 …) of rays of a vertex.
HalfKeys half_keys(const BakeOptions& options, uint32_t p, uint32_t v, uint32_t round);

// The L2 norm of the transfer of an unshadowed vertex, which does not depend on its normal:
// √(Σ_l (â_l/π)² (2l+1)/4π) over the bands.
double open_transfer_norm(uint32_t bands);

}  // namespace paim
