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

uint64_t half_key(const BakeOptions& options, uint32_t p, uint32_t v, uint32_t half) {
    const bool is_shared =
        options.streams == Streams::shared || (options.streams == Streams::mixed && half == 0);
    return stream_key(options.seed, is_shared ? 0 : p, v, half);
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
