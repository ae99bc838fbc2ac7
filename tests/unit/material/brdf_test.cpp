// What every BRDF must hold, and the two of the library in closed form.
#include "compressor/material/brdf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compressor/material/brdfs.h"
#include "compressor/material/lobe_quadrature.h"
#include "paim/base/seed.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

const char* const kBrdfs[] = {"phong:0.5,1",         "phong:1,32",
                              "phong:1,10000",       "lambertian:1",
                              "cook-torrance:1,1",   "cook-torrance:0.04,0.5",
                              "cook-torrance:1,0.2", "cook-torrance:0.9,0.02"};

std::unique_ptr<Brdf> make(const char* text) {
    add_lambertian();
    return parse_brdf(text);
}

Vec3d direction(double cosine, double azimuth) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

TEST(Brdf, IsReciprocalIsotropicAndNeverNegative) {
    for (const char* text : kBrdfs) {
        const auto brdf = make(text);
        RandomStream random(1);
        for (int n = 0; n < 2000; ++n) {
            const Vec3d in = direction(random.uniform(), 2.0 * kPi * random.uniform());
            // Half of them in the lobe.
            Vec3d out = n % 2 == 0 ? brdf->sample(in, random.uniform(), random.uniform())
                                   : direction(random.uniform(), 2.0 * kPi * random.uniform());
            const double value = brdf->value(in, out);
            EXPECT_GE(value, 0.0);
            if (out.z() <= 0.0) {
                EXPECT_EQ(value, 0.0) << text;
                EXPECT_EQ(brdf->value(out, in), 0.0) << text;
                continue;
            }
            // Directions are rounded to 2e-16. The narrowest lobe is 2e-4 wide (α = 4e-4), and the
            // value changes by at most 4 times the relative change of the distance to its middle.
            const double tolerance = 1e-10 * (value + 1.0);
            EXPECT_NEAR(brdf->value(out, in), value, tolerance) << text;
            const Eigen::AngleAxisd turn(1.0, Vec3d::UnitZ());
            EXPECT_NEAR(brdf->value(turn * in, turn * out), value, tolerance) << text;
            const auto across = [](const Vec3d& d) { return Vec3d(d.x(), -d.y(), d.z()); };
            EXPECT_NEAR(brdf->value(across(in), across(out)), value, tolerance) << text;
        }
    }
}

double albedo(const Brdf& brdf, double cosine) {
    std::vector<LobeQuadrature::Point> points;
    LobeQuadrature(brdf).points(cosine, points);
    double sum = 0.0;
    for (const auto& [v, value, weight] : points) sum += value * weight * v.z();
    return sum;
}

TEST(Brdf, ReflectsAtMostAllLight) {
    for (const char* text : kBrdfs) {
        const auto brdf = make(text);
        for (const double cosine : {1.0, 0.9, 0.7, 0.4, 0.1, 0.01}) {
            EXPECT_LE(albedo(*brdf, cosine), 1.0 + 1e-6) << text << " at " << cosine;
        }
    }
    // Closed forms. The lobe of Phong at normal incidence: ks (n + 2) ∫ c^(n + 1) dc = ks.
    for (const char* text : {"phong:0.5,1", "phong:0.5,32", "phong:0.5,10000"}) {
        EXPECT_NEAR(albedo(*make(text), 1.0), 0.5, 1e-6) << text;
    }
    // Facets that all lie flat are a mirror of reflectance Schlick.
    const double c = 0.3, f = 0.5 + 0.5 * std::pow(1.0 - c, 5.0);
    // α = 4e-4: what facets turn out of the mirror direction changes the reflectance by their angle
    // times its slope, which averages out to first order.
    EXPECT_NEAR(albedo(*make("cook-torrance:0.5,0.02"), c), f, 1e-4);
}

// χ² of samples in cells of equal solid angle.
TEST(Brdf, SamplesFollowTheDensity) {
    constexpr int kHeights = 10, kAzimuths = 8, kFine = 40, kSamples = 200'000;
    for (const char* text : {"phong:0.5,1", "phong:0.5,12", "lambertian:1", "cook-torrance:0.5,1",
                             "cook-torrance:0.5,0.6"}) {
        const auto brdf = make(text);
        for (const double cosine : {1.0, 0.7, 0.2}) {
            const Vec3d out = direction(cosine, 0.4);
            std::vector<double> expected(kHeights * kAzimuths, 0.0), found(expected);
            constexpr double kCell = 4.0 * kPi / (kHeights * kAzimuths);
            for (int j = 0; j < kHeights * kFine; ++j) {
                for (int i = 0; i < kAzimuths * kFine; ++i) {
                    const double z = -1.0 + 2.0 * (j + 0.5) / (kHeights * kFine);
                    const double azimuth = 2.0 * kPi * (i + 0.5) / (kAzimuths * kFine);
                    expected[static_cast<size_t>(j / kFine * kAzimuths + i / kFine)] +=
                        brdf->pdf(direction(z, azimuth), out) * kCell / (kFine * kFine) * kSamples;
                }
            }
            RandomStream random(7);
            for (int n = 0; n < kSamples; ++n) {
                const double u = random.uniform();
                const Vec3d in = brdf->sample(out, u, random.uniform());
                ASSERT_NEAR(in.norm(), 1.0, 1e-12);
                const auto j = static_cast<int>(0.5 * (in.z() + 1.0) * kHeights);
                const double turns = std::atan2(in.y(), in.x()) / (2.0 * kPi);
                const auto i = static_cast<int>((turns - std::floor(turns)) * kAzimuths);
                ++found[static_cast<size_t>(std::min(j, kHeights - 1) * kAzimuths +
                                            std::min(i, kAzimuths - 1))];
            }
            double chi2 = 0.0, rest_expected = 0.0, rest_found = 0.0;
            int freedom = -1;
            for (size_t cell = 0; cell < expected.size(); ++cell) {
                if (expected[cell] < 10.0) {
                    rest_expected += expected[cell];
                    rest_found += found[cell];
                    continue;
                }
                chi2 += std::pow(found[cell] - expected[cell], 2.0) / expected[cell];
                ++freedom;
            }
            EXPECT_NEAR(rest_found, rest_expected, 5.0 * std::sqrt(rest_expected) + 5.0) << text;
            // Wilson and Hilferty: the cube root is normal. Five standard deviations.
            const double spread = 2.0 / (9.0 * freedom);
            const double z = (std::cbrt(chi2 / freedom) - (1.0 - spread)) / std::sqrt(spread);
            EXPECT_LT(z, 5.0) << text << " at " << cosine << ": " << chi2 << " of " << freedom;
        }
    }
}

// Narrow lobes, by the mean of value · g / density against quadrature.
TEST(Brdf, SamplesIntegrateNarrowLobes) {
    constexpr int kSamples = 100'000;
    for (const char* text :
         {"phong:1,10000", "phong:1,100", "cook-torrance:0.9,0.02", "cook-torrance:0.2,0.3"}) {
        const auto brdf = make(text);
        for (const double cosine : {1.0, 0.6, 0.15}) {
            const Vec3d out = direction(cosine, 0.0);
            RandomStream random(3);
            double sum = 0.0, squares = 0.0;
            for (int n = 0; n < kSamples; ++n) {
                const double u = random.uniform();
                const Vec3d in = brdf->sample(out, u, random.uniform());
                const double value = brdf->value(in, out);
                const double x = value > 0.0 ? value * in.z() / brdf->pdf(in, out) : 0.0;
                sum += x;
                squares += x * x;
            }
            const double mean = sum / kSamples;
            const double variance = squares / kSamples - mean * mean;
            // Five standard errors, and the error of the quadrature.
            EXPECT_NEAR(mean, albedo(*brdf, cosine), 5.0 * std::sqrt(variance / kSamples) + 1e-6)
                << text << " at " << cosine;
        }
    }
}

// Half of the value at the half width.
TEST(Brdf, HasTheWidthThatItStates) {
    for (const char* text : {"phong:0.5,10", "phong:1,10000", "cook-torrance:0.5,0.3"}) {
        const auto brdf = make(text);
        const Vec3d up = Vec3d::UnitZ();
        const double half = brdf->value(up, direction(std::cos(brdf->half_width_rad()), 0.0));
        // Masking and Fresnel change the value a little.
        EXPECT_NEAR(half / brdf->value(up, up), 0.5, 0.02) << text;
    }
}

}  // namespace
}  // namespace paim
