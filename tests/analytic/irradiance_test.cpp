// Irradiance of unoccluded surfaces in closed form, from the map's pixels to the sum over
// coefficients.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "paim/light/environment.h"
#include "paim/sh/basis.h"
#include "paim/sh/cosine_lobe.h"
#include "paim/sh/zonal.h"
#include "tests/unit/sh/directions.h"

namespace paim {
namespace {

// Irradiance / π of a surface with the normal: Σ_i cosine_lobe(l) y_i(n) L_i, what albedo 1 shows.
template <typename Coefficients>
double irradiance_over_pi(const Coefficients& light, int bands, const Vec3d& normal) {
    std::vector<double> basis(static_cast<size_t>(sh::num_coefficients(bands)));
    sh::evaluate_basis(bands, normal, basis);
    double sum = 0.0;
    for (size_t i = 0; i < basis.size(); ++i) {
        sum += sh::cosine_lobe(sh::band_of(static_cast<int>(i))) * basis[i] * light(i);
    }
    return sum;
}

TEST(Irradiance, OfAConstantLightIsTheLight) {
    constexpr int kBands = 6;
    const LightCoefficients light = project_latlong(Image(256, 128, Vec3f(2, 2, 2)), kBands);
    for (const Vec3d& normal : test_directions()) {
        // Pixels' centres err by h²/24 · l(l+1) at l = 2 and 4 (lobe 1/4 and 1/24), some 1e-4.
        EXPECT_NEAR(
            irradiance_over_pi([&](size_t i) { return light.values[i].x(); }, kBands, normal), 2.0,
            2e-4);
    }
}

TEST(Irradiance, OfTheUpperHalfIsLinearInTheNormalsHeight) {
    // (1 + n_y) / 2. The half space has no even bands and the lobe no odd ones but the first, so
    // that two bands are exact.
    constexpr int kBands = 6;
    const std::vector<double> zonal = sh::cone_zonal(kBands, kPi / 2.0);
    const std::vector<double> exact = sh::zonal_to_axis(zonal, Vec3d::UnitY());
    Image image(256, 128);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 256; ++x) image.at(x, y) = Vec3f(1, 1, 1);
    }
    const LightCoefficients light = project_latlong(image, kBands);
    for (const Vec3d& normal : test_directions()) {
        const double expected = 0.5 * (1.0 + normal.y());
        EXPECT_NEAR(irradiance_over_pi([&](size_t i) { return exact[i]; }, kBands, normal),
                    expected, 1e-14);
        EXPECT_NEAR(
            irradiance_over_pi([&](size_t i) { return light.values[i].x(); }, kBands, normal),
            expected, 2e-4);  // as above
    }
}

TEST(Irradiance, FacingAConeIsItsSineSquared) {
    for (const double angle : {0.05, 0.5, 1.2}) {
        const std::vector<double> light = sh::cone_zonal(sh::kMaxBands, angle);
        double sum = 0.0;
        for (int l = 0; l < sh::kMaxBands; ++l) {
            sum += sh::cosine_lobe(l) * band_maximum(l) * light[static_cast<size_t>(l)];
        }
        // Beyond band l the terms are below l^-2 · 2 sin α, of alternating sign.
        EXPECT_NEAR(sum, std::sin(angle) * std::sin(angle), 1e-3 * std::sin(angle)) << angle;
    }
}

}  // namespace
}  // namespace paim
