// How a bake gets the noise that an error allows.
#include "compressor/encode/search/less_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compressor/bake/bake_options.h"

namespace paim {

namespace {

// Encoding takes out more of much noise than of little. So the error of the encoded bake falls more
// slowly with the rays than its noise: as rays^-0.59 where that falls as rays^-0.75
// (docs/results/noise.md).
constexpr double kEncodedPerNoise = 0.78;

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

}  // namespace

std::string less_noise_hint(const BakeIdentity& identity, const TransferError& best,
                            double transfer_error) {
    // What noise may have of the error; components and integers take the rest.
    constexpr double kShare = 0.85;
    const double allowed =
        kShare * std::sqrt(std::max(0.0, transfer_error * transfer_error -
                                             best.missing_bands * best.missing_bands));
    // The shares of the noise that is there, and of its rays.
    const double less = std::pow(allowed / best.error, 1.0 / kEncodedPerNoise);
    const double more = std::pow(less, -2.0 / noise_power(identity.sampler));
    const bool has_target = identity.transfer_error > 0.0;
    const double rays = more * identity.rays;
    if (!has_target && !(rays <= kMostRays)) {
        return fmt::format("not even --rays {} would do: ask for a larger error", kMostRays);
    }
    // An even number, since a vertex has two halves.
    const auto even = static_cast<uint32_t>(
        2.0 * std::ceil(0.5 * two_digits(std::min<double>(rays, kMostRays), &std::ceil)));
    if (has_target) {
        return fmt::format(
            "bake with less noise: --noise-target {:g}% instead of {:g}% should do, with --rays {} "
            "or more",
            two_digits(100.0 * less * identity.transfer_error, &std::floor),
            100.0 * identity.transfer_error, std::min(even, kMostRays));
    }
    return fmt::format("bake with more --rays: {} instead of {} should do", even, identity.rays);
}

}  // namespace paim
