// The light of a scene: the sum of its parts, computed again only where something changed.
#include "player/light/light_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/light/sky.h"

namespace paim::player {
namespace {

float largest_difference(const LightCoefficients& a, const LightCoefficients& b) {
    EXPECT_EQ(a.bands, b.bands);
    EXPECT_EQ(a.values.size(), b.values.size());
    float largest = 0.0f;
    for (size_t i = 0; i < a.values.size(); ++i) {
        largest = std::max(largest, (a.values[i] - b.values[i]).cwiseAbs().maxCoeff());
    }
    return largest;
}

TEST(LightRig, IsTheEnvironmentAtFirst) {
    const EnvironmentLight sky(make_sky(32));
    LightRig rig(sky);
    EXPECT_EQ(largest_difference(rig.coefficients(5), sky.coefficients(5)), 0.0f);
    EXPECT_EQ(rig.environment_from_world(), Eigen::Matrix3f::Identity());
    EXPECT_FALSE(rig.key_light());
}

TEST(LightRig, TurnsTheEnvironmentAsTheOptionDoes) {
    const EnvironmentLight sky(make_sky(32));
    LightRig rig(sky);
    rig.set_orientation({70.0, 0.0, 0.0});
    const LightCoefficients expected = turn_about_y(sky.coefficients(5), 70.0 * kPi / 180.0);
    // Floats of values of about 2.
    EXPECT_LT(largest_difference(rig.coefficients(5), expected), 1e-6f);
    rig.set_orientation({0.0, 0.0, 0.0});
    EXPECT_EQ(largest_difference(rig.coefficients(5), sky.coefficients(5)), 0.0f);
}

// What arrives from a direction of the scene is what the map has where environment_from_world() says.
TEST(LightRig, ShowsTheMapWhereItsLightComesFrom) {
    Image image(64, 32);
    image.at(10, 9) = Vec3f::Constant(100.0f);
    LightRig rig{EnvironmentLight(image)};
    rig.set_orientation({50.0, -35.0, 110.0});
    const Vec3d in_map = direction_from_latlong(10.5 / 64, 9.5 / 32);
    const Vec3f in_scene = rig.orientation().rotation().cast<float>() * in_map.cast<float>();
    EXPECT_LT((rig.environment_from_world() * in_scene - in_map.cast<float>()).norm(), 1e-6f);
    // Band 1 of a single light points to it: its coefficients are those of y, z and x.
    const LightCoefficients& light = rig.coefficients(2);
    const Vec3f towards(light.values[3].x(), light.values[1].x(), light.values[2].x());
    EXPECT_LT((towards.normalized() - in_scene).norm(), 1e-5f);
}

TEST(LightRig, AddsTheKeyLightToTheDimmedEnvironment) {
    const EnvironmentLight sky(make_sky(32));
    LightRig rig(sky);
    KeyLight key;
    key.azimuth_deg = 30.0;
    rig.set_key_light(key);
    rig.set_environment_strength(0.25f);
    // The key light does not turn with the environment.
    rig.set_orientation({90.0, 0.0, 0.0});
    LightCoefficients expected = turn_about_y(sky.coefficients(4), 0.5 * kPi);
    const LightCoefficients of_key = key.coefficients(4);
    for (size_t i = 0; i < expected.values.size(); ++i) {
        expected.values[i] = 0.25f * expected.values[i] + of_key.values[i];
    }
    EXPECT_LT(largest_difference(rig.coefficients(4), expected), 1e-6f);
    rig.set_environment_strength(0.0f);
    EXPECT_EQ(largest_difference(rig.coefficients(4), of_key), 0.0f);
}

TEST(LightRig, ProjectsAMapOnce) {
    LightRig rig{EnvironmentLight(make_sky(16))};
    EXPECT_EQ(rig.num_projections(), 0u);
    const LightCoefficients five = rig.coefficients(5);
    rig.set_orientation({1.0, 2.0, 3.0});
    rig.coefficients(5);
    rig.set_key_light(KeyLight{});
    rig.set_environment_strength(2.0f);
    rig.coefficients(5);
    EXPECT_EQ(rig.num_projections(), 1u);
    // Fewer bands are a part of those that are known; more are not.
    rig.coefficients(3);
    EXPECT_EQ(rig.num_projections(), 1u);
    rig.coefficients(7);
    rig.coefficients(5);
    EXPECT_EQ(rig.num_projections(), 2u);
    rig.set_environment(EnvironmentLight(make_sky(32)));
    rig.coefficients(5);
    EXPECT_EQ(rig.num_projections(), 3u);
}

TEST(LightRig, BandsDoNotDependOnEachOther) {
    LightRig few{EnvironmentLight(make_sky(16))}, many{EnvironmentLight(make_sky(16))};
    for (LightRig* rig : {&few, &many}) {
        rig->set_orientation({40.0, 20.0, 60.0});
        rig->set_key_light(KeyLight{});
    }
    const LightCoefficients nine = many.coefficients(9);
    EXPECT_EQ(largest_difference(few.coefficients(4), many.coefficients(4)), 0.0f);
    // Nor on the order in which they are asked for after a change.
    many.set_environment_strength(2.0f);
    many.set_orientation({0.0, 0.0, 0.0});
    many.set_environment_strength(1.0f);
    many.set_orientation({40.0, 20.0, 60.0});
    many.coefficients(4);
    EXPECT_EQ(largest_difference(many.coefficients(9), nine), 0.0f);
}

TEST(LightRig, CountsChangesAndNothingElse) {
    const EnvironmentLight sky(make_sky(16));
    LightRig rig(sky);
    uint64_t before = rig.revision();
    const auto changed = [&] {
        const bool grown = rig.revision() > before;
        before = rig.revision();
        return grown;
    };
    rig.coefficients(5);
    EXPECT_FALSE(changed());
    rig.set_orientation({10.0, 0.0, 0.0});
    EXPECT_TRUE(changed());
    rig.set_orientation({10.0, 0.0, 0.0});
    EXPECT_FALSE(changed());
    KeyLight key;
    rig.set_key_light(key);
    EXPECT_TRUE(changed());
    rig.set_key_light(key);
    EXPECT_FALSE(changed());
    key.color.y() = 0.5f;
    rig.set_key_light(key);
    EXPECT_TRUE(changed());
    rig.set_key_light(std::nullopt);
    EXPECT_TRUE(changed());
    rig.set_environment_strength(0.5f);
    EXPECT_TRUE(changed());
    rig.set_environment_strength(0.5f);
    EXPECT_FALSE(changed());
    rig.set_environment(sky);  // a copy of the light that is there
    EXPECT_FALSE(changed());
    rig.set_environment(EnvironmentLight(make_sky(16)));
    EXPECT_TRUE(changed());
}

TEST(LightRig, EveryChangeIsSeen) {
    LightRig rig{EnvironmentLight(make_sky(16))};
    LightCoefficients before = rig.coefficients(4);
    const auto seen = [&] {
        const LightCoefficients now = rig.coefficients(4);
        const bool differs = largest_difference(before, now) > 1e-3f;
        before = now;
        return differs;
    };
    EXPECT_FALSE(seen());
    rig.set_orientation({0.0, 30.0, 0.0});
    EXPECT_TRUE(seen());
    rig.set_key_light(KeyLight{});
    EXPECT_TRUE(seen());
    rig.set_environment_strength(3.0f);
    EXPECT_TRUE(seen());
    rig.set_environment(EnvironmentLight(Image(4, 2, Vec3f::Ones())));
    EXPECT_TRUE(seen());
    rig.set_key_light(std::nullopt);
    EXPECT_TRUE(seen());
}

TEST(LightRigDeathTest, RefusesImpossibleStrengths) {
    LightRig rig{EnvironmentLight(Image(2, 1))};
    EXPECT_DEATH(rig.set_environment_strength(-1.0f), "check failed");
    EXPECT_DEATH(rig.set_environment_strength(std::nanf("")), "check failed");
}

}  // namespace
}  // namespace paim::player
