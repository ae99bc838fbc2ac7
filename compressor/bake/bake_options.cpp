// Options of the baker.
#include "compressor/bake/bake_options.h"

#include <cmath>

#include "paim/base/seed.h"
#include "paim/sh/cosine_lobe.h"

namespace paim {

const char* streams_name(Streams streams) {
    switch (streams) {
        case Streams::per_pose:
            return "per-pose";
        case Streams::shared:
            return "shared";
        case Streams::mixed:
            return "mixed";
    }
    return "unknown";
}

HalfRelation half_relation(const BakeOptions& options) {
    return options.streams == Streams::mixed ? HalfRelation::independent
                                             : HalfRelation::interleaved;
}

HalfKeys half_keys(const BakeOptions& options, uint32_t p, uint32_t v, uint32_t round) {
    HalfKeys keys{};
    for (uint32_t half = 0; half < 2; ++half) {
        const bool is_shared =
            options.streams == Streams::shared || (options.streams == Streams::mixed && half == 0);
        keys[half] = stream_key(options.seed, is_shared ? 0 : p, v, 2 * round + half);
    }
    return keys;
}

double open_transfer_norm(uint32_t bands) {
    double energy = 0.0;
    for (int l = 0; l < static_cast<int>(bands); ++l) {
        // Σ_m y_lm(n)² = (2l+1)/4π for every n (the addition theorem).
        energy += sh::cosine_lobe(l) * sh::cosine_lobe(l) * (2 * l + 1) / (4.0 * kPi);
    }
    return std::sqrt(energy);
}

}  // namespace paim
