// A glossy body that travels and turns: turned, and with and without a root motion.
#include <cmath>
#include <span>
#include <vector>

#include "paim/base/gauss_legendre.h"
#include "paim/base/seed.h"
#include "paim/sh/basis.h"
#include "paim/shade/exit_radiance.h"
#include "tests/cli/gloss_scene.h"
#include "tests/random_light.h"

namespace paim {
namespace {

// [R] directions that differ from row to row, turned.
std::vector<Vec3f> some_directions(size_t num_rows, const Eigen::Matrix3d& turn) {
    RandomStream random(17);
    std::vector<Vec3f> directions;
    for (size_t r = 0; r < num_rows; ++r) {
        const auto number = [&] { return 2.0 * random.uniform() - 1.0; };
        const double x = number(), y = number(), z = number();
        directions.emplace_back((turn * Vec3d(x, y, z).normalized()).cast<float>());
    }
    return directions;
}

// What rows send in directions of the scene that are turned by `turn`.
std::vector<Vec3f> sent(const Playback& playback, size_t part, const Eigen::Matrix3d& turn) {
    const std::span<const Vec3f> exit = playback.exit_radiance(part);
    const size_t num_rows = exit.size() / (kSceneOutBands * kSceneOutBands);
    const Eigen::Matrix3d to_local = playback.root(part).rotation.conjugate().toRotationMatrix();
    std::vector<Vec3f> radiance(num_rows);
    exit_towards(kSceneOutBands, exit, some_directions(num_rows, to_local * turn), radiance);
    return radiance;
}

// Coefficients of a light that is polynomial of degree 2, turned.
LightCoefficients some_light(const Eigen::Matrix3d& turn) {
    LightCoefficients light{kSceneBands,
                            std::vector<Vec3f>(kSceneBands * kSceneBands, Vec3f::Zero())};
    const Vec3d along = turn * Vec3d(1.0, 2.0, -0.5).normalized();
    const Vec3d across = turn * Vec3d(-0.7, 0.4, 1.0).normalized();
    constexpr int kSteps = 8;  // integrals are of degree 4
    for (const auto& [z, weight] : gauss_legendre(kSteps, -1.0, 1.0)) {
        for (int step = 0; step < kSteps; ++step) {
            const double phi = 2.0 * kPi * step / kSteps, radius = std::sqrt(1.0 - z * z);
            const Vec3d d(radius * std::cos(phi), radius * std::sin(phi), z);
            const double value = 1.0 + 0.8 * d.dot(along) + 0.9 * std::pow(d.dot(across), 2);
            std::vector<double> basis(kSceneBands * kSceneBands);
            sh::evaluate_basis(kSceneBands, d, std::span(basis));
            for (size_t i = 0; i < basis.size(); ++i) {
                light.values[i].array() +=
                    static_cast<float>(weight * 2.0 * kPi / kSteps * value * basis[i]);
            }
        }
    }
    return light;
}

// The body alone. A body that is turned is one at rest under a light that is turned the other way, seen by
// an eye that is turned the other way.
TEST_F(GlossScene, TurnedBodyIsOneAtRestUnderALightTurnedTheOtherWay) {
    bake_body("rigid", "rigid.bake", {"--root-motion", "rigid"});
    encode_whole("rigid.bake", "rigid.paim");
    for (const char* const seed : {"1", "2"}) {
        const std::string name = std::string("rest") + seed;
        bake_body("rigid/0.obj", name + ".bake", {"--seed", seed});
        encode_whole(name + ".bake", name + ".paim");
    }
    Playback moving = play("rigid.paim"), rest = play("rest1.paim"), other = play("rest2.paim");
    ASSERT_EQ(moving.asset().moving().root_motion.size(), kScenePoses);
    ASSERT_TRUE(rest.asset().moving().root_motion.empty());
    const Vec3d eye(3.0, 4.0, 9.0);
    // Of what is sent, and of what the eye sees of both reflections.
    Squares gloss, seen, gloss_noise, seen_noise, wrong;
    for (uint32_t p = 1; p < kScenePoses; ++p) {
        const Place place(p);
        const Eigen::Matrix3d back = place.turn.transpose();
        moving.set_light(DistantLight(some_light(Eigen::Matrix3d::Identity())));
        moving.set_eye(Vec3f(eye.cast<float>()));
        moving.update(p);
        for (Playback* const still : {&rest, &other}) {
            still->set_light(DistantLight(some_light(back)));
            still->set_eye(Vec3f((back * (eye - place.shift)).cast<float>()));
            still->update(0.0);
        }
        const std::vector<Vec3f> of_rest = sent(rest, 0, back);
        gloss.add(sent(moving, 0, Eigen::Matrix3d::Identity()), of_rest);
        seen.add(moving.radiance(), rest.radiance());
        gloss_noise.add(sent(other, 0, back), of_rest);
        seen_noise.add(other.radiance(), rest.radiance());
        rest.set_light(DistantLight(some_light(place.turn)));
        rest.update(0.0);
        wrong.add(sent(rest, 0, back), of_rest);
    }
    // The body is baked with other rays in every pose, so that both differ as two seeds do. The ratio is
    // that of sums over 3000 vertices, whose noises differ a lot: as many as 100 of the same size, each
    // χ² with one degree of freedom, so that both roots are known to 7 % and the ratio to 10 %.
    EXPECT_NEAR(gloss.relative() / gloss_noise.relative(), 1.0, 0.3);
    EXPECT_NEAR(seen.relative() / seen_noise.relative(), 1.0, 0.3);
    EXPECT_LT(gloss_noise.relative(), 0.05);
    EXPECT_GT(wrong.relative(), 5.0 * gloss.relative());
}

// With a root motion, everything is coded in the axes of the body; without one, in those of the scene. Rays
// are the same.
TEST_F(GlossScene, IsTheSameWithAndWithoutARootMotion) {
    bake_all("rigid.bake");
    bake_all("none.bake", "none");
    encode_whole("rigid.bake", "rigid.paim");
    encode_whole("none.bake", "none.paim");
    Playback rigid = play("rigid.paim"), none = play("none.paim");
    ASSERT_EQ(rigid.asset().moving().root_motion.size(), kScenePoses);
    ASSERT_TRUE(none.asset().moving().root_motion.empty());
    ASSERT_LT(rigid.asset().moving().num_following, rigid.asset().moving().topology.num_vertices);
    ASSERT_EQ(rigid.asset().moving().gloss->num_rows, 1000u);
    for (Playback* const playback : {&rigid, &none}) {
        playback->set_light(DistantLight(random_light(kSceneBands, 3)));
        playback->set_eye(Vec3f(3.0f, 4.0f, 9.0f));
    }
    for (uint32_t p = 0; p < kScenePoses; ++p) {
        rigid.update(p);
        none.update(p);
        for (size_t part = 0; part < 2; ++part) {
            Squares gloss, seen;
            gloss.add(sent(rigid, part, Eigen::Matrix3d::Identity()),
                      sent(none, part, Eigen::Matrix3d::Identity()));
            seen.add(rigid.radiance(part), none.radiance(part));
            // Roundings of floats: of coefficients when they are turned, of sums of 9 products, of
            // means and three components.
            EXPECT_LT(gloss.relative(), 3e-6) << p << ' ' << part;
            EXPECT_LT(seen.relative(), 3e-6) << p << ' ' << part;
            EXPECT_GT(gloss.all, 1.0) << p << ' ' << part;
        }
    }
}

}  // namespace
}  // namespace paim
