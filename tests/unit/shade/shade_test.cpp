// CPU shading and the camera.
#include "paim/shade/shade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/shade/camera.h"

namespace paim {
namespace {

TEST(Shade, IsAlbedoTimesTransferTimesLight) {
    // Two vertices, two bands, one channel.
    const TransferLayout layout{TransferKind::diffuse, 2, 1};
    const std::vector<float> transfer{1, 2, 3, 4, 5, 6, 7, 8};  // [plane][V]
    LightCoefficients light{2, {Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1), Vec3f(1, 1, 1)}};
    Albedo albedo{{Vec3f(1, 1, 1), Vec3f(0.5f, 0.5f, 0.25f)}};
    std::vector<Vec3f> radiance;
    shade(layout, transfer, albedo, light, radiance);
    EXPECT_EQ(radiance[0], Vec3f(1 + 7, 3 + 7, 5 + 7));
    EXPECT_EQ(radiance[1], Vec3f((2 + 8) * 0.5f, (4 + 8) * 0.5f, (6 + 8) * 0.25f));
}

TEST(Shade, TakesThreeChannelsAndFewerLightBands) {
    const TransferLayout layout{TransferKind::diffuse, 2, 3};
    std::vector<float> transfer(12);
    for (size_t j = 0; j < 12; ++j) transfer[j] = static_cast<float>(j);
    const LightCoefficients light{1, {Vec3f(1, 10, 100)}};
    std::vector<Vec3f> radiance;
    shade(layout, transfer, {{Vec3f::Ones()}}, light, radiance);
    EXPECT_EQ(radiance[0], Vec3f(0, 4 * 10, 8 * 100));
}

TEST(Camera, FramesAllCornersOfTheBounds) {
    // Of any size, and as far from the origin as they are large.
    for (const auto& [scale, aspect] : {std::pair{1.0f, 0.5f},
                                        {1.0f, 1.0f},
                                        {1.0f, 2.0f},
                                        {1e-12f, 1.5f},
                                        {1e7f, 1.5f},
                                        {1e12f, 1.5f}}) {
        Bounds bounds;
        bounds.extend(scale * Vec3f(-10, 0, 2));
        bounds.extend(scale * Vec3f(4, 2, 7));
        const Camera camera = frame_bounds(bounds, aspect, 1.0f, 0.4f);
        const float half_height = std::tan(0.5f * camera.vertical_fov_rad);
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3f point(corner & 1 ? bounds.upper.x() : bounds.lower.x(),
                              corner & 2 ? bounds.upper.y() : bounds.lower.y(),
                              corner & 4 ? bounds.upper.z() : bounds.lower.z());
            const Vec3f local = camera.axes().transpose() * (point - camera.eye);
            EXPECT_LE(std::abs(local.x()), -local.z() * half_height * aspect);
            EXPECT_LE(std::abs(local.y()), -local.z() * half_height);
        }
    }
}

}  // namespace
}  // namespace paim
