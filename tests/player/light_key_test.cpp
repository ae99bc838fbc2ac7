// The key light against quadrature of its disc, its irradiance, and its turned self.
#include "player/light/key_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "paim/base/gauss_legendre.h"
#include "paim/light/environment.h"
#include "paim/sh/basis_reference.h"
#include "paim/sh/cosine_lobe.h"

namespace paim::player {
namespace {

KeyLight make_key(double azimuth_deg, double elevation_deg, double diameter_deg) {
    KeyLight key;
    key.azimuth_deg = azimuth_deg;
    key.elevation_deg = elevation_deg;
    key.angular_diameter_deg = diameter_deg;
    key.color = Vec3f(1.0f, 0.5f, 0.0f);
    key.strength = 3.0;
    return key;
}

// Irradiance of a surface with this normal, as the coefficients have it, first channel.
double irradiance(const LightCoefficients& light, const Vec3d& normal) {
    double sum = 0.0;
    for (int l = 0; l < light.bands; ++l) {
        for (int m = -l; m <= l; ++m) {
            sum += kPi * sh::cosine_lobe(l) * sh::basis_reference(l, m, normal) *
                   static_cast<double>(light.values[static_cast<size_t>(sh::index(l, m))].x());
        }
    }
    return sum;
}

TEST(KeyLight, StandsWhereACameraWould) {
    EXPECT_LT((make_key(0, 0, 10).direction() - Vec3d::UnitZ()).norm(), 1e-15);
    EXPECT_LT((make_key(90, 0, 10).direction() - Vec3d::UnitX()).norm(), 1e-15);
    EXPECT_LT((make_key(33, 90, 10).direction() - Vec3d::UnitY()).norm(), 1e-15);
}

// ∫ L y_lm over the disc in its own polar coordinates: polynomials of the cosine of degree 9, and
// trigonometric ones of the azimuth, both integrated exactly.
TEST(KeyLight, IsTheIntegralOverItsDisc) {
    constexpr int kBands = 10, kAzimuths = 32;
    for (const double diameter_deg : {0.5, 12.0, 90.0, 180.0}) {
        const KeyLight key = make_key(130.0, -35.0, diameter_deg);
        const LightCoefficients light = key.coefficients(kBands);
        const Vec3d axis = key.direction();
        const Vec3d side = axis.unitOrthogonal();
        const Vec3d other = axis.cross(side);
        const double cosine = std::cos(0.5 * diameter_deg * kPi / 180.0);
        std::vector<double> sums(kBands * kBands);
        for (const auto& [z, weight] : gauss_legendre(16, cosine, 1.0)) {
            const double across = std::sqrt(1.0 - z * z);
            for (int j = 0; j < kAzimuths; ++j) {
                const double phi = 2.0 * kPi * j / kAzimuths;
                const Vec3d direction =
                    z * axis + across * std::cos(phi) * side + across * std::sin(phi) * other;
                for (int l = 0; l < kBands; ++l) {
                    for (int m = -l; m <= l; ++m) {
                        sums[static_cast<size_t>(sh::index(l, m))] +=
                            weight * 2.0 * kPi / kAzimuths * sh::basis_reference(l, m, direction);
                    }
                }
            }
        }
        const Vec3d radiance = key.disc_radiance();
        for (size_t i = 0; i < sums.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                // Floats of values up to 3 · sqrt(19/4π) = 3.7. The area of the smallest disc,
                // 6e-5, is known to 2^-53, and so its coefficients to 1e-11.
                EXPECT_NEAR(light.values[i][c], sums[i] * radiance[c], 5e-7)
                    << diameter_deg << " " << i;
            }
        }
    }
}

// The disc as pixels of a map: covers() and the conventions of maps agree with the coefficients.
TEST(KeyLight, IsADiscInAMap) {
    const KeyLight key = make_key(-70.0, 25.0, 40.0);
    Image map(720, 360);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const Vec3d direction =
                direction_from_latlong((x + 0.5) / map.width, (y + 0.5) / map.height);
            if (key.covers(direction)) map.at(x, y) = key.disc_radiance().cast<float>();
        }
    }
    const LightCoefficients expected = project_latlong(map, 6);
    const LightCoefficients light = key.coefficients(6);
    for (size_t i = 0; i < light.values.size(); ++i) {
        // The rim crosses 250 pixels of half a degree, each of which is in or out as a whole: an
        // error of 1/sqrt(12) of a pixel each, random in sign, is 0.03 % of the disc's 5000 pixels.
        EXPECT_LT((light.values[i] - expected.values[i]).cwiseAbs().maxCoeff(), 0.003f) << i;
    }
}

// A surface that faces a hemisphere of light needs two bands: of the cosine there are bands 0 and 1
// and even ones, of the hemisphere band 0 and odd ones.
TEST(KeyLight, StrengthIsTheIrradianceOfAFacingSurface) {
    const KeyLight widest = make_key(20.0, 50.0, 180.0);
    EXPECT_NEAR(irradiance(widest.coefficients(2), widest.direction()), 3.0, 1e-6);
    EXPECT_NEAR(irradiance(widest.coefficients(9), widest.direction()), 3.0, 1e-6);
    for (const double diameter_deg : {0.5, 5.0, 40.0}) {
        const KeyLight key = make_key(20.0, 50.0, diameter_deg);
        // For a point the terms of even bands have alternating signs and fall, so that the sum is off
        // by less than the first one that is left out: (2l+1)/4 · 2/((l+2)(l−1)) · binomial, with the
        // binomial below sqrt(2/(π l)). It is 7e-4 of the strength for l = 64, and wider discs have less.
        EXPECT_NEAR(irradiance(key.coefficients(sh::kMaxBands), key.direction()), 3.0, 0.003)
            << diameter_deg;
        // A surface that is edge-on to a light so small has next to nothing, one that looks away
        // nothing.
        EXPECT_NEAR(irradiance(key.coefficients(sh::kMaxBands), -key.direction()), 0.0, 0.003);
    }
}

TEST(KeyLight, SizeKeepsTheBrightness) {
    const double small = irradiance(make_key(0, 40, 0.5).coefficients(3), Vec3d::UnitY());
    const double large = irradiance(make_key(0, 40, 20.0).coefficients(3), Vec3d::UnitY());
    // Band l of a disc of radius 10 degrees is smaller by about l(l+1)/8 · 0.03.
    EXPECT_NEAR(small, large, 0.03 * small);
}

TEST(KeyLight, TurnsLikeAllLight) {
    const LightCoefficients at_0 = make_key(0.0, 25.0, 30.0).coefficients(8);
    for (const double azimuth_deg : {45.0, -120.0, 180.0}) {
        const LightCoefficients expected = turn_about_y(at_0, azimuth_deg * kPi / 180.0);
        const LightCoefficients light = make_key(azimuth_deg, 25.0, 30.0).coefficients(8);
        for (size_t i = 0; i < light.values.size(); ++i) {
            // Floats of values of about 4.
            EXPECT_LT((light.values[i] - expected.values[i]).cwiseAbs().maxCoeff(), 2e-6f);
        }
    }
    // Elevation, too: from the horizon at +Z to the zenith about −X.
    const LightCoefficients raised =
        turn(make_key(0.0, 0.0, 30.0).coefficients(8),
             Eigen::AngleAxisd(-0.5 * kPi, Vec3d::UnitX()).toRotationMatrix());
    const LightCoefficients zenith = make_key(0.0, 90.0, 30.0).coefficients(8);
    for (size_t i = 0; i < zenith.values.size(); ++i) {
        EXPECT_LT((zenith.values[i] - raised.values[i]).cwiseAbs().maxCoeff(), 2e-6f);
    }
}

TEST(KeyLight, IsLinearInColourAndStrength) {
    KeyLight key = make_key(10.0, 20.0, 30.0);
    const LightCoefficients before = key.coefficients(4);
    key.strength *= 4.0;
    key.color = Vec3f(0.5f, 1.0f, 2.0f);
    const LightCoefficients after = key.coefficients(4);
    for (size_t i = 0; i < after.values.size(); ++i) {
        const float red = before.values[i].x();
        EXPECT_LT((after.values[i] - Vec3f(2.0f * red, 4.0f * red, 8.0f * red)).norm(), 1e-5f);
    }
    key.strength = 0.0;
    for (const Vec3f& value : key.coefficients(4).values) EXPECT_TRUE(value.isZero(0.0f));
}

TEST(KeyLightDeathTest, RefusesSizesThatNoDiscHas) {
    for (const double diameter_deg : {0.0, 0.49, 180.5, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_DEATH(make_key(0, 0, diameter_deg).coefficients(3), "check failed") << diameter_deg;
    }
}

}  // namespace
}  // namespace paim::player
