// How a bake gets the noise that an error allows.
#include "compressor/encode/search/less_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compressor/bake/bake_options.h"
#include "compressor/encode/search/target_words.h"

namespace paim {

namespace {

// Encoding takes out more of much noise than of little. So the error of the encoded bake falls more
// slowly with the rays than its noise: as rays^-0.62 where that falls as rays^-0.75
// (docs/results/noise.md).
constexpr double kEncodedPerNoise = 0.83;
// What noise may have of the error; components and integers take the rest.
constexpr double kNoiseShare = 0.85;

// The exponent p of the squared noise ∝ rays^−p.
double noise_power(const std::string& sampler) {
    for (const SamplerKind kind : kSamplerKinds) {
        if (sampler == sampler_name(kind)) return error_power(kind);
    }
    return error_power(SamplerKind::uniform);  // the slowest
}

// A number of two digits next to `number`: below or above it, by `round`.
double two_digits(double number, double (*round)(double)) {
    const double unit = std::pow(10.0, std::floor(std::log10(number)) - 1.0);
    return unit * round(number / unit);
}

// The share of its noise that a bake may keep.
double noise_share(const TransferError& best, double transfer_error) {
    const double allowed =
        kNoiseShare * std::sqrt(std::max(0.0, transfer_error * transfer_error -
                                                  best.missing_bands * best.missing_bands));
    return std::pow(allowed / best.error, 1.0 / kEncodedPerNoise);
}

// An even number, since a vertex has two halves.
uint32_t even_rays(double rays) {
    return static_cast<uint32_t>(2.0 * std::ceil(0.5 * std::min<double>(rays, kMostRays)));
}

double wanted_rays(const BakeIdentity& identity, double noise_share) {
    return identity.rays * std::pow(noise_share, -2.0 / noise_power(identity.sampler));
}

}  // namespace

std::optional<uint32_t> rays_for(const BakeIdentity& identity, const TransferError& best,
                                 double transfer_error) {
    if (identity.transfer_error > 0.0) return std::nullopt;
    if (best.error == 0.0) return 2;
    const double rays = wanted_rays(identity, noise_share(best, transfer_error));
    if (!(rays <= kMostRays)) return std::nullopt;
    return even_rays(std::max(2.0, rays));
}

std::string less_noise_hint(const BakeIdentity& identity, const TransferError& best,
                            double transfer_error) {
    if (identity.transfer_error > 0.0) {
        const double share = noise_share(best, transfer_error);
        const double rays = two_digits(wanted_rays(identity, share), &std::ceil);
        return fmt::format(
            "bake with less noise: --noise-target {:g}% instead of {:g}% should do, with --rays {} "
            "or more",
            two_digits(100.0 * share * identity.transfer_error, &std::floor),
            100.0 * identity.transfer_error, even_rays(rays));
    }
    const std::optional<uint32_t> rays = rays_for(identity, best, transfer_error);
    if (!rays) {
        return fmt::format("not even --rays {} would do: {}", kMostRays,
                           target_words(identity.layout).larger);
    }
    return fmt::format("bake with more --rays: {} instead of {} should do",
                       even_rays(two_digits(*rays, &std::ceil)), identity.rays);
}

}  // namespace paim
