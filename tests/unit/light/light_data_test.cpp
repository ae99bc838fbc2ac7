// OpenEXR's orientation map: the axes that are painted on it lie where our conventions put them.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "paim/image/exr.h"
#include "paim/light/environment.h"

namespace paim {
namespace {

const std::filesystem::path kData = PAIM_DATA_DIR;

TEST(LightData, ThePaintedAxesAreOurs) {
    // Each face of the cube shows, from its centre, a dark line towards each positive axis across
    // it (on +X towards +Y and +Z, on −X likewise), and none towards negative ones. A map that were
    // mirrored or turned by more than a line's width would show them elsewhere. Text on a face
    // covers up to a third of the way that should be bright.
    const EnvironmentLight map(read_exr(kData / "env" / "OrientationLatLong.exr"));
    const auto brightness = [&](const Vec3d& direction) {
        return map.radiance(direction).sum() / 3.0f;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            const Vec3d face = sign * Vec3d::Unit(axis);
            for (int across = 0; across < 3; ++across) {
                if (across == axis) continue;
                // Samples along the line, clear of the corner where the two lines meet.
                float towards_positive = 0.0f, towards_negative = 0.0f;
                constexpr int kSamples = 16;
                for (int i = 0; i < kSamples; ++i) {
                    const double t = 0.08 + 0.22 * i / kSamples;
                    towards_positive += brightness(face + t * Vec3d::Unit(across)) / kSamples;
                    towards_negative += brightness(face - t * Vec3d::Unit(across)) / kSamples;
                }
                EXPECT_LT(towards_positive, 0.4f) << face.transpose() << " towards " << across;
                EXPECT_GT(towards_negative, 0.6f) << face.transpose() << " towards " << across;
            }
        }
    }
}

TEST(LightData, RealMapsAreLights) {
    for (const char* name : {"venice", "forest", "night", "studio"}) {
        const EnvironmentLight light(read_exr(kData / "env" / (std::string(name) + ".exr")));
        const LightCoefficients coefficients = light.coefficients(7);
        for (const Vec3f& value : coefficients.values) EXPECT_TRUE(value.allFinite()) << name;
        EXPECT_GT(coefficients.values[0].minCoeff(), 0.0f) << name;
    }
}

}  // namespace
}  // namespace paim
