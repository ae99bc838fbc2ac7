// Reference images of meshes of every size.
#include "paim/render/render.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "poses/octopus.h"

namespace paim {
namespace {

constexpr int kWidth = 60;
constexpr int kHeight = 40;

// The octopus, each vertex with a radiance of its own, scaled.
Image render_scaled(const std::vector<Vec3f>& positions, const Topology& topology, float scale,
                    float azimuth_rad) {
    std::vector<Vec3f> scaled = positions;
    Bounds bounds;
    for (Vec3f& x : scaled) {
        x *= scale;
        bounds.extend(x);
    }
    std::vector<std::vector<Vec3f>> radiance(1);
    for (const Vec3f& x : positions) radiance[0].push_back(Vec3f::Ones() + x.cwiseAbs());
    const Camera camera =
        frame_bounds(bounds, static_cast<float>(kWidth) / kHeight, azimuth_rad, 0.4f);
    return render_images(topology, scaled, radiance, camera, kWidth, kHeight)[0];
}

TEST(RenderImages, DoNotDependOnTheSize) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const std::vector<Vec3f> positions = octopus.load_pose(0).positions;
    for (const float azimuth_rad : {kDefaultAzimuth_rad, -2.0f}) {
        const Image image = render_scaled(positions, octopus.topology(), 1.0f, azimuth_rad);
        EXPECT_GT(std::count_if(image.pixels.begin(), image.pixels.end(),
                                [](const Vec3f& pixel) { return !pixel.isZero(0.0f); }),
                  100);
        // Scaling by powers of two is exact, and so is all that cameras and rays make of it: the
        // eye stands at up to seven times the largest coordinate, 2^2, below 2^128.
        for (const int exponent : {-110, -90, -70, 70, 90, 120}) {
            EXPECT_TRUE(render_scaled(positions, octopus.topology(), std::ldexp(1.0f, exponent),
                                      azimuth_rad)
                            .pixels == image.pixels)
                << exponent;
        }
    }
}

TEST(RenderImagesDeathTest, RefuseACameraOutOfRange) {
    const Topology topology{3, {{0, 1, 2}}};
    const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    Camera camera;
    camera.eye.x() = INFINITY;
    EXPECT_DEATH(render_images(topology, positions, {}, camera, 4, 4), "camera");
}

}  // namespace
}  // namespace paim
