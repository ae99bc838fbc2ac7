// Outgoing coefficients of BRDFs against slow integrals over the hemisphere.
#include "compressor/material/exit_functions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compressor/material/brdfs.h"
#include "compressor/material/open_gloss.h"
#include "paim/base/gauss_legendre.h"
#include "paim/base/seed.h"
#include "paim/sh/basis.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

constexpr int kBands = 5;

// 2 ∫ f(s, v) y_o(v) dv by Gauss–Legendre panels over the whole hemisphere, [bands²], and the albedo
// after them.
std::vector<double> brute_force(const Brdf& brdf, const Vec3d& in, int panels) {
    std::vector<double> sums(kBands * kBands + 1, 0.0), basis(kBands * kBands);
    const auto nodes = gauss_legendre(8, 0.0, 1.0);
    for (int j = 0; j < panels; ++j) {
        for (const auto& [at, height] : nodes) {
            const double z = (j + at) / panels;
            const double sine = std::sqrt(1.0 - z * z);
            constexpr int kAzimuths = 1280;
            for (int i = 0; i < kAzimuths; ++i) {
                const double azimuth = 2.0 * kPi * (i + 0.5) / kAzimuths;
                const Vec3d v(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
                const double share = brdf.value(in, v) * height / panels * 2.0 * kPi / kAzimuths;
                if (share == 0.0) continue;
                sh::evaluate_basis(kBands, v, std::span(basis));
                for (size_t o = 0; o < basis.size(); ++o) sums[o] += 2.0 * share * basis[o];
                sums.back() += share * z;
            }
        }
    }
    return sums;
}

TEST(ExitFunctions, AreTheIntegralsOfTheirDefinition) {
    struct Case {
        const char* text;
        int panels;
    };
    for (const Case& c : {Case{"phong:0.5,1", 40}, Case{"phong:0.5,40", 24},
                          Case{"cook-torrance:0.3,0.8", 24}, Case{"cook-torrance:0.3,0.4", 40}}) {
        const auto brdf = parse_brdf(c.text);
        const ExitFunctions functions(*brdf, kBands);
        double largest = 0.0;
        for (int k = 0; k <= 100; ++k) {
            largest = std::max(largest, 0.01 * k * functions.at(0, 0, 0.01 * k));
        }
        for (const double cosine : {0.999, 0.8, 0.45, 0.2, 0.08}) {
            const double azimuth = 0.7, sine = std::sqrt(1.0 - cosine * cosine);
            const Vec3d in(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
            const std::vector<double> expected = brute_force(*brdf, in, c.panels);
            float x[16], y[16], z[16];
            std::fill_n(x, 16, static_cast<float>(in.x()));
            std::fill_n(y, 16, static_cast<float>(in.y()));
            std::fill_n(z, 16, static_cast<float>(in.z()));
            std::vector<float> values(static_cast<size_t>(functions.num_rows()) * 16);
            functions.evaluate(x, y, z, values.data());
            // The error that the class states; that of the slow integral is smaller.
            const double tolerance = 1e-4 * largest;
            for (size_t row = 0; row < values.size() / 16; ++row) {
                const auto o = static_cast<size_t>(functions.coefficients()[row]);
                EXPECT_NEAR(cosine * static_cast<double>(values[row * 16 + 5]),
                            cosine * expected[o], tolerance)
                    << c.text << " at " << cosine << ", coefficient " << o;
            }
            EXPECT_NEAR(functions.albedo(cosine), expected.back(), tolerance) << c.text;
        }
    }
}

TEST(ExitFunctions, OfALambertianSurfaceAreOneNumber) {
    const ExitFunctions functions(Lambertian(0.5), 3);
    for (const double cosine : {1.0, 0.5, 0.01, 0.0}) {
        // 2 · 0.5/π · 2π y₀; sums of floats.
        EXPECT_NEAR(functions.at(0, 0, cosine), 1.0 / std::sqrt(kPi), 2e-6);
        // Even functions of positive degree have no mean over the hemisphere.
        EXPECT_NEAR(functions.at(2, 0, cosine), 0.0, 2e-6);
        EXPECT_NEAR(functions.at(2, 2, cosine), 0.0, 2e-6);
        EXPECT_NEAR(functions.albedo(cosine), 0.5, 1e-6);
    }
}

// The transfer of an open vertex against a mean over random directions.
TEST(OpenGloss, IsTheIntegralOverTheHemisphere) {
    const auto brdf = parse_brdf("phong:0.7,20");
    const ExitFunctions functions(*brdf, 4);
    constexpr int kInBands = 3, kIn = kInBands * kInBands;
    const std::vector<double> open = open_gloss(functions, kInBands);
    const auto num_rows = static_cast<size_t>(functions.num_rows());
    std::vector<double> sums(num_rows * kIn, 0.0), squares(sums), basis(kIn);
    std::vector<float> values(num_rows * 16);
    RandomStream random(5);
    constexpr int kBatches = 20'000;
    for (int batch = 0; batch < kBatches; ++batch) {
        float x[16], y[16], z[16];
        for (int j = 0; j < 16; ++j) {
            const double height = random.uniform(), azimuth = 2.0 * kPi * random.uniform();
            const double sine = std::sqrt(1.0 - height * height);
            x[j] = static_cast<float>(sine * std::cos(azimuth));
            y[j] = static_cast<float>(sine * std::sin(azimuth));
            z[j] = static_cast<float>(height);
        }
        functions.evaluate(x, y, z, values.data());
        for (size_t j = 0; j < 16; ++j) {
            const Vec3d s(static_cast<double>(x[j]), static_cast<double>(y[j]),
                          static_cast<double>(z[j]));
            sh::evaluate_basis(kInBands, s, std::span(basis));
            for (size_t r = 0; r < sums.size(); ++r) {
                const double b = s.z() * static_cast<double>(values[r / kIn * 16 + j]);
                const double sample = 2.0 * kPi * b * basis[r % kIn];
                sums[r] += sample;
                squares[r] += sample * sample;
            }
        }
    }
    constexpr double kSamples = 16.0 * kBatches;
    for (size_t r = 0; r < sums.size(); ++r) {
        const double mean = sums[r] / kSamples;
        const double error = std::sqrt((squares[r] / kSamples - mean * mean) / kSamples);
        // 90 values: five standard errors are passed by chance once in 20,000 seeds.
        EXPECT_NEAR(open[r], mean, 5.0 * error + 1e-7) << r;
    }
    // A Lambertian surface has the cosine lobe: λ_l y_l0(z) √4π for light of band l.
    const std::vector<double> lobe = open_gloss(ExitFunctions(Lambertian(1.0), 1), 3);
    EXPECT_NEAR(lobe[0], 1.0, 2e-6);
    EXPECT_NEAR(lobe[2], 2.0 / 3.0 * std::sqrt(3.0), 2e-6);
    EXPECT_NEAR(lobe[6], 0.25 * std::sqrt(5.0), 2e-6);
}

}  // namespace
}  // namespace paim
