// Directions of lat-long maps, and which maps make a light.
#include "paim/light/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "paim/base/error.h"
#include "paim/base/seed.h"
#include "tests/unit/sh/directions.h"

namespace paim {
namespace {

TEST(LatLong, FollowsOpenExr) {
    // Corners and centres by the definition: the first pixel's corner is latitude π/2, longitude π.
    const auto expect = [](double u, double v, const Vec3d& direction) {
        // A few roundings of π.
        EXPECT_LT((direction_from_latlong(u, v) - direction).norm(), 1e-15) << u << " " << v;
    };
    expect(0.0, 0.0, Vec3d::UnitY());
    expect(0.7, 1.0, -Vec3d::UnitY());
    expect(0.0, 0.5, -Vec3d::UnitZ());
    expect(0.25, 0.5, Vec3d::UnitX());
    expect(0.5, 0.5, Vec3d::UnitZ());
    expect(0.75, 0.5, -Vec3d::UnitX());
    expect(1.0, 0.5, -Vec3d::UnitZ());
    expect(0.5, 0.25, Vec3d(0, std::sqrt(0.5), std::sqrt(0.5)));
}

TEST(LatLong, RoundTripsDirections) {
    for (const Vec3d& d : test_directions()) {
        const auto [u, v] = latlong_from_direction(3.0 * d);
        EXPECT_TRUE(u >= 0.0 && u < 1.0) << u;
        EXPECT_TRUE(v >= 0.0 && v <= 1.0) << v;
        // Angles are rounded to 2^-52 of π.
        EXPECT_LT((direction_from_latlong(u, v) - d).norm(), 2e-15) << d.transpose();
    }
}

TEST(LatLong, RoundTripsCoordinates) {
    RandomStream random(stream_key(2, 0, 0));
    for (int i = 0; i < 100; ++i) {
        const double u = random.uniform();
        const double v = 0.01 + 0.98 * random.uniform();
        const auto [u_back, v_back] = latlong_from_direction(direction_from_latlong(u, v));
        // 2^-53 over sin(0.01 π), where longitudes lie close.
        EXPECT_NEAR(u_back, u, 1e-14);
        EXPECT_NEAR(v_back, v, 1e-14);
    }
}

TEST(LatLong, ClosesTheSeamAndThePoles) {
    // Both signs of zero and of the smallest numbers on the meridian opposite to +Z.
    const double tiny = std::numeric_limits<double>::denorm_min();
    for (const double x : {0.0, -0.0, tiny, -tiny, 1e-17, -1e-17}) {
        const double u = latlong_from_direction(Vec3d(x, 0.0, -1.0)).first;
        EXPECT_TRUE(u >= 0.0 && u < 1.0) << x << " " << u;
    }
    EXPECT_EQ(latlong_from_direction(Vec3d(0, 2, 0)).second, 0.0);
    EXPECT_EQ(latlong_from_direction(Vec3d(0, -2, 0)).second, 1.0);
}

std::string error_of(Image image) {
    try {
        const EnvironmentLight light(std::move(image));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

TEST(EnvironmentLight, RefusesWhatIsNotRadiance) {
    EXPECT_EQ(error_of(Image()), "environment light: 0 x 0 pixels, expected at least 1 x 1");
    Image image(8, 8, Vec3f(1, 1, 1));
    image.at(3, 7).y() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(error_of(image), "environment light: pixel (3, 7) is nan, expected finite");
    image.at(3, 7).y() = std::numeric_limits<float>::infinity();
    EXPECT_EQ(error_of(image), "environment light: pixel (3, 7) is inf, expected finite");
}

TEST(EnvironmentLight, BearsALittleBelowZeroAndKeepsIt) {
    // One pixel of the 8 in the middle rows, of 3 · 8 · 8 weighted values in all.
    Image image(8, 8, Vec3f(1, 1, 1));
    image.at(5, 4).z() = -1.0f;
    EXPECT_EQ(EnvironmentLight(image).image().at(5, 4).z(), -1.0f);
    image.at(5, 4).z() = -20.0f;
    const std::string message = error_of(image);
    EXPECT_EQ(message.find("environment light: pixel (5, 4) is -20, and values below zero"), 0u)
        << message;
    EXPECT_NE(error_of(Image(2, 2, Vec3f(-1, -1, -1))), "no error");
    EXPECT_EQ(error_of(Image(2, 2)), "no error");  // night is black
}

// A row at a pole is a smaller part of the sphere than one at the equator: values below zero count
// by solid angle, sin θ at the row's centre. Ones, and one row of −x whose share x sin θ / Σ others
// is just below or above the 5 % that are allowed.
TEST(EnvironmentLight, WeighsValuesBelowZeroBySolidAngle) {
    constexpr int kHeight = 8;
    const auto row_weight = [](int y) { return std::sin(kPi * (y + 0.5) / kHeight); };
    double all = 0.0;
    for (int y = 0; y < kHeight; ++y) all += row_weight(y);
    for (const int row : {0, 3, 4, 7}) {
        const double limit = 0.05 * (all - row_weight(row)) / row_weight(row);
        const auto error_of_share = [&](double share_of_limit) {
            Image image(6, kHeight, Vec3f(1, 1, 1));
            const auto value = static_cast<float>(-share_of_limit * limit);
            for (int x = 0; x < 6; ++x) image.at(x, row) = Vec3f::Constant(value);
            return error_of(image);
        };
        EXPECT_EQ(error_of_share(0.99), "no error") << row;
        EXPECT_NE(error_of_share(1.01).find("values below zero sum to"), std::string::npos) << row;
    }
}

TEST(EnvironmentLight, RadianceInterpolatesPixelCentres) {
    Image image(8, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) {
            image.at(x, y) = Vec3f(static_cast<float>(x), static_cast<float>(y), 1.0f);
        }
    }
    const EnvironmentLight light(image);
    const auto at = [&](double x, double y) {  // pixel coordinates, centres at j + 0.5
        return light.radiance(direction_from_latlong(x / 8.0, y / 4.0));
    };
    const auto expect = [](const Vec3f& got, const Vec3f& expected) {
        EXPECT_LT((got - expected).norm(), 1e-5f) << got.transpose();  // float rounding of 7
    };
    expect(at(2.5, 1.5), Vec3f(2, 1, 1));
    expect(at(3.0, 2.0), Vec3f(2.5f, 1.5f, 1));
    // Across the seam, between columns 7 and 0, from either side.
    expect(at(7.75, 1.5), Vec3f(7.0f * 0.75f, 1, 1));
    expect(at(0.25, 1.5), Vec3f(7.0f * 0.25f, 1, 1));
    // Beyond the outermost centres rows go on as they are.
    expect(at(4.5, 0.1), Vec3f(4, 0, 1));
    expect(at(4.5, 3.9), Vec3f(4, 3, 1));
}

TEST(EnvironmentLight, CoefficientsAreTheProjection) {
    const Image image(4, 2, Vec3f(1, 2, 3));
    const EnvironmentLight light(image);
    EXPECT_EQ(light.coefficients(3).values, project_latlong(image, 3).values);
    EXPECT_EQ(light.at(Vec3f(5, 5, 5), 3).values, project_latlong(image, 3).values);
}

}  // namespace
}  // namespace paim
