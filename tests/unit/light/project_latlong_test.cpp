// Projections with known answers: constants, a cone in closed form, and the sum over pixels itself.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/light/environment.h"
#include "paim/sh/basis_reference.h"
#include "paim/sh/zonal.h"

namespace paim {
namespace {

Image random_image(int width, int height) {
    RandomStream random(stream_key(21, 0, 0));
    Image image(width, height);
    for (Vec3f& pixel : image.pixels) {
        for (float& value : pixel) value = static_cast<float>(random.uniform());
    }
    return image;
}

TEST(ProjectLatLong, IsTheSumOverPixels) {
    // The definition, pixel by pixel, with the slow basis. Sizes that are odd, single and tall.
    for (const auto& [width, height] : {std::pair{31, 17}, {1, 1}, {2, 9}, {40, 1}}) {
        const Image image = random_image(width, height);
        constexpr int kBands = 9;
        std::vector<Vec3d> expected(kBands * kBands, Vec3d::Zero());
        for (int y = 0; y < height; ++y) {
            const double top = kPi * (0.5 - static_cast<double>(y) / height);
            const double bottom = kPi * (0.5 - static_cast<double>(y + 1) / height);
            const double solid_angle = 2.0 * kPi / width * (std::sin(top) - std::sin(bottom));
            for (int x = 0; x < width; ++x) {
                const Vec3d centre = direction_from_latlong((x + 0.5) / width, (y + 0.5) / height);
                for (int i = 0; i < kBands * kBands; ++i) {
                    const int l = sh::band_of(i);
                    expected[static_cast<size_t>(i)] +=
                        image.at(x, y).cast<double>() * solid_angle *
                        sh::basis_reference(l, i - sh::index(l, 0), centre);
                }
            }
        }
        const LightCoefficients light = project_latlong(image, kBands);
        ASSERT_EQ(light.bands, kBands);
        ASSERT_EQ(light.values.size(), expected.size());
        for (size_t i = 0; i < expected.size(); ++i) {
            // Rounding to float of values below 4π · 1.2, 2^-24 · 16.
            EXPECT_LT((light.values[i].cast<double>() - expected[i]).norm(), 1e-6) << i;
        }
    }
}

TEST(ProjectLatLong, AConstantHasOnlyItsAverage) {
    const Vec3f radiance(0.5f, 1.0f, 3.0f);
    const LightCoefficients light = project_latlong(Image(256, 128, radiance), 8);
    const Vec3d expected = std::sqrt(4.0 * kPi) * radiance.cast<double>();
    // Solid angles sum to 4π exactly, so only the rounding to float remains.
    EXPECT_LT((light.values[0].cast<double>() - expected).norm(), 1e-6 * expected.norm());
    for (size_t i = 1; i < light.values.size(); ++i) {
        const int l = sh::band_of(static_cast<int>(i));
        // Taking y_i at centres of pixels of side h = π/128 errs by h²/24 · |Δy_i|, where Δy_i is
        // −l(l+1) y_i, whose mean magnitude is below 1/sqrt(4π), over 4π.
        const double h = kPi / 128.0;
        const double bound = h * h / 24.0 * l * (l + 1.0) * std::sqrt(4.0 * kPi);
        EXPECT_LT(light.values[i].cast<double>().cwiseAbs().maxCoeff(), 3.0 * bound) << i;
    }
}

// The part of each pixel of the map that lies within the half angle round the axis, by 8 × 8
// samples of equal solid angle.
Image cone_image(int height, const Vec3d& axis, double half_angle) {
    constexpr int kSamples = 8;
    Image image(2 * height, height);
    for (int y = 0; y < height; ++y) {
        const double sin_top = std::cos(kPi * y / height);
        const double sin_bottom = std::cos(kPi * (y + 1) / height);
        for (int x = 0; x < image.width; ++x) {
            int inside = 0;
            for (int j = 0; j < kSamples; ++j) {
                const double s = sin_top + (sin_bottom - sin_top) * (j + 0.5) / kSamples;
                const double v = 0.5 - std::asin(s) / kPi;
                for (int i = 0; i < kSamples; ++i) {
                    const double u = (x + (i + 0.5) / kSamples) / image.width;
                    inside += direction_from_latlong(u, v).dot(axis) >= std::cos(half_angle);
                }
            }
            image.at(x, y).setConstant(static_cast<float>(inside) / (kSamples * kSamples));
        }
    }
    return image;
}

TEST(ProjectLatLong, AConeIsItsClosedForm) {
    constexpr int kBands = 6;
    constexpr int kHeight = 128;
    const double half_angle = 0.5;
    for (const Vec3d& axis : {Vec3d(Vec3d::UnitX()), Vec3d(-Vec3d::UnitX()), Vec3d(Vec3d::UnitY()),
                              Vec3d(-Vec3d::UnitY()), Vec3d(Vec3d::UnitZ()), Vec3d(-Vec3d::UnitZ()),
                              Vec3d(Vec3d(1, 2, -3).normalized())}) {
        const LightCoefficients light =
            project_latlong(cone_image(kHeight, axis, half_angle), kBands);
        const std::vector<double> expected =
            sh::zonal_to_axis(sh::cone_zonal(kBands, half_angle), axis);
        const double h = kPi / kHeight;
        for (size_t i = 0; i < expected.size(); ++i) {
            const int l = sh::band_of(static_cast<int>(i));
            // Over the cone's area A: centres err by h²/24 · l(l+1) of y <= sqrt((2l+1)/4π); along
            // its rim, 2π sin α long, the share of a pixel that is inside counts at the pixel's
            // centre instead of its own, at most h/2 away with slope l, over a width h, of random
            // sign, so that a tenth of it is plenty; and so is a tenth of a sample, h/8, for the
            // coverage.
            const double area = 2.0 * kPi * (1.0 - std::cos(half_angle));
            const double rim = 2.0 * kPi * std::sin(half_angle);
            const double largest = std::sqrt((2.0 * l + 1.0) / (4.0 * kPi));
            const double bound = largest * (area * h * h / 24.0 * l * (l + 1.0) +
                                            0.1 * rim * h * h / 2.0 * l + 0.1 * rim * h / 8.0) +
                                 1e-6;
            EXPECT_NEAR(light.values[i].x(), expected[i], bound) << i << " " << axis.transpose();
        }
    }
}

TEST(ProjectLatLong, KeepsChannelsApart) {
    const LightCoefficients light = project_latlong(Image(8, 4, Vec3f(0, 1, 0)), 3);
    for (const Vec3f& value : light.values) {
        EXPECT_EQ(value.x(), 0.0f);
        EXPECT_EQ(value.z(), 0.0f);
    }
}

TEST(ProjectLatLong, DoesNotDependOnThreads) {
    const Image image = random_image(300, 157);
    const auto project = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        return project_latlong(image, 10).values;
    };
    EXPECT_EQ(project(1), project(2));
    EXPECT_EQ(project(1), project(0));
}

TEST(ProjectLatLong, IsFiniteAtTheLargestBand) {
    const LightCoefficients light = project_latlong(random_image(16, 8), sh::kMaxBands);
    for (const Vec3f& value : light.values) ASSERT_TRUE(value.allFinite());
}

TEST(ProjectLatLongDeathTest, RefusesNothing) {
    EXPECT_DEATH(project_latlong(Image(), 3), "check failed.*width");
    EXPECT_DEATH(project_latlong(Image(1, 1), 65), "check failed.*bands");
}

}  // namespace
}  // namespace paim
