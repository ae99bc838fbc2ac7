// Cube maps against OpenEXR's own functions, angular maps against their definition, and the light
// of both against that of lat-long maps.
#include "paim/light/to_latlong.h"

#include <ImfEnvmap.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "paim/light/environment.h"

namespace paim {
namespace {

using Radiance = std::function<Vec3f(const Vec3d&)>;

// Different in every direction, and smooth.
Vec3f smooth(const Vec3d& d) {
    const Vec3d u = d.normalized();
    return Vec3f(static_cast<float>(1.0 + u.x()), static_cast<float>(1.0 + u.y()),
                 static_cast<float>(1.0 + u.z() * u.x()));
}

// The radiance at the places that OpenEXR gives the pixels of a cube map.
Image cube_by_openexr(int size, const Radiance& radiance) {
    Image cube(size, 6 * size);
    const Imath::Box2i window({0, 0}, {size - 1, 6 * size - 1});
    for (int face = 0; face < 6; ++face) {
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                const Imath::V2f in_face(static_cast<float>(i), static_cast<float>(j));
                const auto f = static_cast<Imf::CubeMapFace>(face);
                const Imath::V3f d = Imf::CubeMap::direction(f, window, in_face);
                const Imath::V2f at = Imf::CubeMap::pixelPosition(f, window, in_face);
                cube.at(static_cast<int>(at.x), static_cast<int>(at.y)) =
                    radiance(Vec3d(d.x, d.y, d.z));
            }
        }
    }
    return cube;
}

// Pixels as areas, as Paim reads them: the direction of each pixel's centre.
Image cube_of_areas(int size, const Radiance& radiance) {
    Image cube(size, 6 * size);
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double right = (2.0 * x + 1.0) / size - 1.0;
                const double up = 1.0 - (2.0 * y + 1.0) / size;
                const std::vector<Vec3d> directions{{1, up, right},  {-1, up, -right},
                                                    {right, 1, up},  {right, -1, -up},
                                                    {-right, up, 1}, {right, up, -1}};
                cube.at(x, face * size + y) = radiance(directions[static_cast<size_t>(face)]);
            }
        }
    }
    return cube;
}

Image angular(int size, const Radiance& radiance) {
    Image probe(size, size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double u = (2.0 * x + 1.0) / size - 1.0;
            const double v = 1.0 - (2.0 * y + 1.0) / size;
            const double radius = std::hypot(u, v);
            if (radius > 1.0) continue;
            // (0, 0, −1) turned by the angle away from the centre, towards (u, v).
            const double angle = kPi * radius;
            const double across = radius > 0.0 ? std::sin(angle) / radius : 0.0;
            probe.at(x, y) = radiance(Vec3d(across * u, across * v, -std::cos(angle)));
        }
    }
    return probe;
}

Image latlong(int height, const Radiance& radiance) {
    Image map(2 * height, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            map.at(x, y) =
                radiance(direction_from_latlong((x + 0.5) / map.width, (y + 0.5) / height));
        }
    }
    return map;
}

void expect_map(const Image& map, const Radiance& radiance, float tolerance) {
    ASSERT_EQ(map.width, 2 * map.height);
    const Image expected = latlong(map.height, radiance);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            ASSERT_LT((map.at(x, y) - expected.at(x, y)).cwiseAbs().maxCoeff(), tolerance)
                << x << " " << y;
        }
    }
}

TEST(CubeMap, FacesLieAsInOpenExr) {
    // OpenEXR puts centres of pixels on the edges of a face, so that its directions differ by up
    // to half a pixel: 1 / 64 of a half side, and the radiance by twice its slope of 1.
    expect_map(latlong_from_cube(cube_by_openexr(64, smooth)), smooth, 0.035f);
}

TEST(CubeMap, IsWhatItsPixelsShow) {
    // Between centres a linear function of the face's coordinates, whose second derivatives, below
    // 3, count h² / 8, h = 2 / 64; beyond the outermost centres half a pixel of slope 1.
    expect_map(latlong_from_cube(cube_of_areas(64, smooth)), smooth, 0.02f);
}

TEST(CubeMap, EachFaceIsSeenInItsDirection) {
    const std::vector<Vec3d> axes{Vec3d::UnitX(),  -Vec3d::UnitX(), Vec3d::UnitY(),
                                  -Vec3d::UnitY(), Vec3d::UnitZ(),  -Vec3d::UnitZ()};
    // Down to one pixel a face.
    for (const int size : {1, 5}) {
        Image cube(size, 6 * size);
        for (int y = 0; y < cube.height; ++y) {
            for (int x = 0; x < size; ++x) {
                cube.at(x, y) = Vec3f::Constant(static_cast<float>(1 + y / size));
            }
        }
        const EnvironmentLight light(latlong_from_cube(cube));
        for (size_t face = 0; face < 6; ++face) {
            EXPECT_NEAR(light.radiance(axes[face]).x(), 1.0 + static_cast<double>(face), 1e-5)
                << face;
        }
    }
}

TEST(AngularMap, LooksAlongMinusZ) {
    Image probe(256, 256);
    const auto paint = [&](int x, int y, const Vec3f& colour) {
        for (int j = -3; j <= 3; ++j) {
            for (int i = -3; i <= 3; ++i) probe.at(x + i, y + j) = colour;
        }
    };
    paint(128, 128, Vec3f(1, 0, 0));  // the centre: −Z
    paint(192, 128, Vec3f(0, 1, 0));  // half way to the right: 90°, +X
    paint(128, 64, Vec3f(0, 0, 1));   // half way up: +Y
    const EnvironmentLight light(latlong_from_angular(probe));
    EXPECT_EQ(light.radiance(-Vec3d::UnitZ()), Vec3f(1, 0, 0));
    EXPECT_EQ(light.radiance(Vec3d::UnitX()), Vec3f(0, 1, 0));
    EXPECT_EQ(light.radiance(Vec3d::UnitY()), Vec3f(0, 0, 1));
}

TEST(AngularMap, IsWhatItsPixelsShow) {
    // π / 128 rad from centre to centre; near the rim half a pixel more is not interpolated.
    expect_map(latlong_from_angular(angular(256, smooth)), smooth, 0.02f);
    // Constant up to the rim: what is outside of the circle is not mixed in.
    const Radiance constant = [](const Vec3d&) { return Vec3f(2, 3, 4); };
    for (const int size : {1, 2, 3, 17}) {
        expect_map(latlong_from_angular(angular(size, constant)), constant, 1e-5f);
    }
}

// Small bright lights in every direction keep their energy and place.
TEST(ToLatlong, KeepsTheLightOfSmallSuns) {
    constexpr int kBands = 5;
    for (const Vec3d& sun :
         {Vec3d(-1, 0.9, 0.95), Vec3d(0.3, -1, 0.4), Vec3d(0.1, 0, -1), Vec3d(0, 0.02, 1)}) {
        const Vec3d axis = sun.normalized();
        const Radiance radiance = [&](const Vec3d& d) {
            // 3° wide.
            return Vec3f(Vec3f::Constant(static_cast<float>(
                0.1 + 500.0 * std::exp((axis.dot(d.normalized()) - 1.0) / 1.4e-3))));
        };
        const auto expected = project_latlong(latlong(512, radiance), kBands);
        const auto of_cube =
            project_latlong(latlong_from_cube(cube_of_areas(128, radiance)), kBands);
        const auto of_probe = project_latlong(latlong_from_angular(angular(512, radiance)), kBands);
        for (size_t i = 0; i < expected.values.size(); ++i) {
            // Of the largest; observed 0.002 at most. At +Z, behind the probe, the outermost pixels
            // of the circle stand for all that is beyond their centres; observed 0.016.
            const double limit = 0.005 * expected.values[0].x();
            const double limit_of_probe = axis.z() > 0.99 ? 4.0 * limit : limit;
            EXPECT_NEAR(of_cube.values[i].x(), expected.values[i].x(), limit) << axis.transpose();
            EXPECT_NEAR(of_probe.values[i].x(), expected.values[i].x(), limit_of_probe)
                << axis.transpose();
        }
    }
}

TEST(ToLatlongDeathTest, RefusesOtherShapes) {
    EXPECT_DEATH(latlong_from_cube(Image(4, 23)), "check failed");
    EXPECT_DEATH(latlong_from_angular(Image(4, 5)), "check failed");
}

}  // namespace
}  // namespace paim
