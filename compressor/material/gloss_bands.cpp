// How many bands of light and of outgoing radiance the reflection of a BRDF needs.
#include "compressor/material/gloss_bands.h"

#include <fmt/format.h>

#include <algorithm>

#include "compressor/material/exit_functions.h"
#include "compressor/material/lobe_quadrature.h"
#include "paim/base/check.h"
#include "paim/base/gauss_legendre.h"
#include "paim/sh/basis.h"

namespace paim {

namespace {

constexpr int kAngles = 48;

// The energy of the bands of a function, and all of it, summed over angles.
class BandEnergy {
  public:
    explicit BandEnergy(uint32_t bands) : of_band_(bands, 0.0) {}

    void add(std::span<const double> coefficients, double all, double weight) {
        for (size_t i = 0; i < coefficients.size(); ++i) {
            of_band_[static_cast<size_t>(sh::band_of(static_cast<int>(i)))] +=
                weight * coefficients[i] * coefficients[i];
        }
        all_ += weight * all;
    }

    // [bands + 1]
    std::vector<double> left_out() const {
        std::vector<double> shares{all_ > 0.0 ? 1.0 : 0.0};
        double rest = all_;
        for (const double energy : of_band_) {
            rest -= energy;
            shares.push_back(all_ > 0.0 ? std::clamp(rest / all_, 0.0, 1.0) : 0.0);
        }
        return shares;
    }

  private:
    std::vector<double> of_band_;
    double all_ = 0.0;
};

uint32_t fewest(const std::vector<double>& left_out, double max_error, uint32_t most) {
    uint32_t bands = 1;
    while (bands < most && left_out[bands] > max_error) ++bands;
    return bands;
}

}  // namespace

GlossEnergy gloss_energy(const Brdf& brdf, uint32_t most_bands) {
    const LobeQuadrature quadrature(brdf);
    BandEnergy in(most_bands), out(most_bands);
    const auto bands = static_cast<int>(most_bands);
    std::vector<double> basis(static_cast<size_t>(sh::num_coefficients(bands)));
    std::vector<LobeQuadrature::Point> points;
    for (const auto& [coordinate, length] : gauss_legendre(kAngles, 0.0, 1.0)) {
        const double cosine = ExitFunctions::cosine_of(coordinate);
        quadrature.points(cosine, points);
        // One direction is at this angle and the other at each point: light and view for `out`, view
        // and light for `in`.
        std::vector<double> of_in(basis.size(), 0.0), of_out(basis.size(), 0.0);
        double all_in = 0.0, all_out = 0.0;
        for (const auto& [direction, value, weight] : points) {
            sh::evaluate_basis(bands, direction, std::span(basis));
            const double z = direction.z();
            for (int l = 0; l < bands; ++l) {
                for (int m = 0; m <= l; ++m) {
                    const auto i = static_cast<size_t>(sh::index(l, m));
                    of_in[i] += value * weight * z * basis[i];
                    if ((l + m) % 2 == 0) of_out[i] += 2.0 * value * weight * cosine * basis[i];
                }
            }
            all_in += value * value * weight * z * z;
            all_out += 2.0 * value * value * weight * cosine * cosine;
        }
        // d cosine = 4 coordinate (1 − coordinate²) d coordinate, and the weight of the mean.
        const double share = length * coordinate * (1.0 - coordinate * coordinate) * cosine;
        in.add(of_in, all_in, share);
        out.add(of_out, all_out, share);
    }
    return {in.left_out(), out.left_out()};
}

GlossBands choose_gloss_bands(const GlossEnergy& energy, double max_error, uint32_t most_in,
                              uint32_t most_out) {
    PAIM_CHECK(most_in < energy.left_out_in.size() && most_out < energy.left_out_out.size());
    return given_gloss_bands(energy, fewest(energy.left_out_in, max_error, most_in),
                             fewest(energy.left_out_out, max_error, most_out));
}

GlossBands given_gloss_bands(const GlossEnergy& energy, uint32_t in, uint32_t out) {
    PAIM_CHECK(in >= 1 && in < energy.left_out_in.size());
    PAIM_CHECK(out >= 1 && out < energy.left_out_out.size());
    return {in, out, energy.left_out_in[in], energy.left_out_out[out]};
}

std::string gloss_bands_note(const std::string& brdf, const GlossBands& bands, double max_error) {
    if (bands.error_in <= max_error && bands.error_out <= max_error) return {};
    // Of a lobe whose energy is mostly left out, harmonics show rings about a blurred highlight.
    constexpr double kMostlyLeftOut = 0.5;
    const bool is_mostly_left_out = std::max(bands.error_in, bands.error_out) > kMostlyLeftOut;
    return fmt::format(
        "{}: {} bands of light leave out {:.0f} % and {} bands of outgoing radiance {:.0f} % of the "
        "energy of the reflection: {} (more: --gloss-bands; wider lobes need fewer)",
        brdf, bands.in, 100.0 * bands.error_in, bands.out, 100.0 * bands.error_out,
        is_mostly_left_out ? "its highlights will be blurred, with dark rings around them"
                           : "its highlights will be somewhat blurred");
}

}  // namespace paim
