// Turning the light is turning the mesh the other way: images, 7 bands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compressor/bake/transfer_baker.h"
#include "paim/light/environment.h"
#include "paim/light/sky.h"
#include "paim/mesh/pose_set.h"
#include "paim/metrics/image_error.h"
#include "paim/render/render.h"
#include "paim/shade/shade.h"
#include "poses/octopus.h"

namespace paim {
namespace {

struct Shot {
    Image image;
    double noise = 0.0;  // of the bake, relative
};

// The mesh turned about +Y by mesh_turn, under a light turned by light_turn, seen by a camera that
// turns with the mesh.
Shot shoot(const PoseSet& source, double mesh_turn, double light_turn) {
    const Eigen::Matrix3f turn =
        Eigen::AngleAxisf(static_cast<float>(mesh_turn), Vec3f::UnitY()).toRotationMatrix();
    std::vector<Vec3f> positions = source.load_pose(0).positions;
    for (Vec3f& x : positions) x = turn * x;
    const PoseSet turned(source.topology(), {positions}, source.albedo());
    const BakeOptions options{7, 1024, 1};
    const BakedPose baked = TransferBaker(options).bake(turned.topology(), turned.load_pose(0), 0);
    const EnvironmentLight sky(make_sky());
    std::vector<std::vector<Vec3f>> radiance(1);
    shade({TransferKind::diffuse, 7, 1}, baked.transfer, source.albedo(),
          turn_about_y(sky.coefficients(7), light_turn), radiance[0]);
    Camera camera;
    camera.eye = turn * Vec3f(3, 5, 9);
    camera.target = turn * Vec3f(0, 1.5f, 0);
    return {render_images(source.topology(), positions, radiance, camera, 128, 128)[0],
            baked.statistics.relative_noise()};
}

TEST(Turning, LightOneWayIsMeshTheOther) {
    const PoseSet octopus = poses::make_octopus(3000, 1);
    const double angle = 0.9;
    const Shot light_turned = shoot(octopus, 0.0, angle);
    const Shot mesh_turned = shoot(octopus, -angle, 0.0);
    const double error = compare_images(mesh_turned.image, light_turned.image).visual_error();
    RecordProperty("visual_error", std::to_string(error));
    RecordProperty("noise", std::to_string(light_turned.noise));
    // The two bakes shoot different rays, so the images differ by their noise; a vertex's radiance
    // averages the noise of its coefficients.
    EXPECT_LT(error, 2.0 * light_turned.noise);
    EXPECT_LT(light_turned.noise, 0.03);
    // Without the turn the images have little in common.
    EXPECT_GT(compare_images(shoot(octopus, 0.0, 0.0).image, light_turned.image).visual_error(),
              0.1);
    // Turned the wrong way, too.
    EXPECT_GT(compare_images(shoot(octopus, angle, 0.0).image, light_turned.image).visual_error(),
              0.1);
}

}  // namespace
}  // namespace paim
