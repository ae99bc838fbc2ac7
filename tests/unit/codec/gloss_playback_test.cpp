// Playback of gloss: outgoing coefficients against decoded transfer, radiance against a sum over them.
#include <gtest/gtest.h>

#include <memory>

#include "paim/codec/gloss_player.h"
#include "paim/codec/playback.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/mesh/planes.h"
#include "paim/sh/basis.h"
#include "paim/sh/rotate.h"
#include "tests/gloss_example.h"
#include "tests/random_light.h"

namespace paim {
namespace {

// tint · Σ_i t_oi L_i of the decoded transfer, in the frames of the rows, [K][R].
std::vector<Vec3d> expected_in_frames(const CodedGloss& gloss, double time,
                                      const DecodeLimits& limits, const LightCoefficients& light) {
    TransferLayout layout;
    std::vector<float> transfer;
    gloss.transfer->make_player(gloss.layout)
        ->decode(time, limits_of_gloss(limits), layout, transfer);
    std::vector<Vec3d> exit;
    for (uint32_t o = 0; o < layout.num_outgoing(); ++o) {
        for (uint32_t r = 0; r < gloss.num_rows; ++r) {
            Vec3d sum = Vec3d::Zero();
            for (uint32_t i = 0; i < layout.num_coefficients(); ++i) {
                for (int channel = 0; channel < 3; ++channel) {
                    const uint32_t of = layout.channels == 1 ? 0 : static_cast<uint32_t>(channel);
                    sum[channel] += double{transfer[layout.plane(of, i, o) * gloss.num_rows + r]} *
                                    double{light.values[i][channel]};
                }
            }
            exit.push_back(sum.cwiseProduct(gloss.tint.at(r).cast<double>()));
        }
    }
    return exit;
}

// The same in local axes, [O][R]. Turned by matrices of rotation.
// positions  of the pose
std::vector<Vec3d> expected_exit(const CodedMesh& mesh, std::span<const float> positions,
                                 double time, const DecodeLimits& limits,
                                 const LightCoefficients& light) {
    const CodedGloss& gloss = *mesh.gloss;
    const std::vector<Vec3d> in_frames = expected_in_frames(gloss, time, limits, light);
    std::vector<float> first_pose;
    PositionDecoder().decode(mesh.positions, 0.0, 100, first_pose);
    const auto frames =
        GlossFrames(faces_of_gloss(mesh.topology, gloss.vertices),
                    planes_at(first_pose, gloss.vertices), turn_vectors(gloss.frame_turns))
            .at(planes_at(positions, gloss.vertices));
    const auto out_bands = static_cast<int>(gloss.layout.out_bands);
    std::vector<Vec3d> exit(static_cast<size_t>(out_bands * out_bands) * gloss.num_rows,
                            Vec3d::Zero());
    for (uint32_t r = 0; r < gloss.num_rows; ++r) {
        const sh::Rotation rotation(out_bands, frames[r].cast<double>());
        for (int k = 0; k < sh::num_even_coefficients(out_bands); ++k) {
            const int l = sh::band_of_even(k);
            for (int i = 0; i < 2 * l + 1; ++i) {
                exit[static_cast<size_t>(l * l + i) * gloss.num_rows + r] +=
                    rotation.block(l)(i, sh::even_coefficient(k) - l * l) *
                    in_frames[static_cast<size_t>(k) * gloss.num_rows + r];
            }
        }
    }
    return exit;
}

Vec3d position_of(std::span<const float> planes, uint32_t v) {
    const size_t n = planes.size() / 3;
    return {double{planes[v]}, double{planes[n + v]}, double{planes[2 * n + v]}};
}

// Compares with sums of at most 4 · 9 products of floats, up to 4,000 integers large where values
// are integers: relative to the largest, roundings of 50 additions.
void expect_near_sum(const Vec3f& got, const Vec3d& expected, double scale) {
    EXPECT_LT((got.cast<double>() - expected).norm(), 50 * 0x1p-23 * scale);
}

double largest_norm(const std::vector<Vec3d>& values) {
    double most = 1.0;
    for (const Vec3d& value : values) most = std::max(most, value.norm());
    return most;
}

TEST(GlossPlayback, SumsOutgoingCoefficientsTowardsTheEye) {
    const LightCoefficients light = random_light(3, 5);
    for (GlossVariant& variant : gloss_variants()) {
        SCOPED_TRACE(variant.name);
        CodedGloss& turned = *variant.asset.moving().gloss;
        turned.frame_turns = frame_turns(std::vector<Vec3f>(turned.num_rows, Vec3f(0.5f, 1, -2)));
        const auto asset = std::make_shared<const Asset>(std::move(variant.asset));
        const CodedGloss& gloss = *asset->moving().gloss;
        Playback playback(asset), diffuse(asset);
        playback.set_light(DistantLight(light));
        diffuse.set_light(DistantLight(light));
        const Vec3f eye(3, -5, 2);
        playback.set_eye(eye);
        for (const double time : {0.0, 1.25, 4.0}) {
            DecodeLimits limits;
            if (time > 2.0) limits = {2, 2, 2, 1, 1, 1};
            playback.update(time, limits);
            diffuse.update(time, limits);
            const std::vector<Vec3d> exit =
                expected_exit(asset->moving(), playback.local_positions(), time, limits, light);
            const double scale = largest_norm(exit);
            ASSERT_EQ(playback.exit_radiance().size(), exit.size());
            for (size_t j = 0; j < exit.size(); ++j) {
                expect_near_sum(playback.exit_radiance()[j], exit[j], 4.0 * scale);
            }
            std::vector<Vec3d> radiance(4);
            for (uint32_t v = 0; v < 4; ++v) radiance[v] = diffuse.radiance()[v].cast<double>();
            ASSERT_EQ(playback.gloss_radiance().size(), size_t{gloss.num_rows});
            for (uint32_t r = 0; r < gloss.num_rows; ++r) {
                const uint32_t v = gloss.vertex(r);
                const Vec3d direction = eye.cast<double>() - position_of(playback.positions(), v);
                std::vector<double> values(4);
                sh::evaluate_basis(2, direction, std::span(values));
                Vec3d sum = Vec3d::Zero();
                for (size_t o = 0; o < 4; ++o) sum += values[o] * exit[o * gloss.num_rows + r];
                expect_near_sum(playback.gloss_radiance()[r], sum, 8.0 * scale);
                radiance[v] += sum;
            }
            for (uint32_t v = 0; v < 4; ++v) {
                expect_near_sum(playback.radiance()[v], radiance[v], 8.0 * scale);
            }
        }
    }
}

TEST(GlossPlayback, IsDiffuseWithoutAnEye) {
    const auto asset = std::make_shared<const Asset>(with_partial_gloss());
    Asset matte = *asset;
    matte.moving().gloss.reset();
    Playback playback(asset), expected(std::make_shared<const Asset>(std::move(matte)));
    for (Playback* one : {&playback, &expected}) {
        one->set_light(DistantLight(random_light(3, 6)));
        one->update(1.5);
    }
    const std::vector<Vec3f> radiance(expected.radiance().begin(), expected.radiance().end());
    const auto shown = [&] {
        return std::vector<Vec3f>(playback.radiance().begin(), playback.radiance().end());
    };
    EXPECT_EQ(shown(), radiance);
    EXPECT_TRUE(playback.gloss_radiance().empty());
    playback.set_eye(Vec3f(1, 2, 3));
    EXPECT_EQ(shown(), radiance);  // until the next update
    EXPECT_TRUE(playback.exit_radiance().empty());
    playback.update(1.5);
    EXPECT_NE(shown(), radiance);
    // Vertex 1 has no gloss.
    EXPECT_EQ(playback.radiance()[1], radiance[1]);
    playback.set_eye({});
    EXPECT_NE(shown(), radiance);
    playback.update(1.5);
    EXPECT_EQ(shown(), radiance);
}

// What was computed before makes no difference.
TEST(GlossPlayback, FollowsEyeLightAndPose) {
    const auto asset = std::make_shared<const Asset>(with_gloss(make_gloss_alone(3, true, false)));
    struct Moment {
        double time;
        uint64_t light;
        Vec3f eye;
    };
    Playback reused(asset);
    for (const Moment& moment :
         {Moment{0, 1, {1, 0, 0}}, Moment{0, 1, {0, 9, 0}}, Moment{0, 2, {0, 9, 0}},
          Moment{2.5, 2, {0, 9, 0}}, Moment{2.5, 2, {0, 9, 0}}}) {
        Playback fresh(asset);
        for (Playback* one : {&reused, &fresh}) {
            one->set_light(DistantLight(random_light(3, moment.light)));
            one->set_eye(moment.eye);
            one->update(moment.time);
        }
        for (size_t v = 0; v < 4; ++v) {
            // A pose that is lit again sums in another order.
            expect_near_sum(reused.radiance()[v], fresh.radiance()[v].cast<double>(), 10.0);
        }
    }
}

// Body, light and eye turned together show the same.
TEST(GlossPlayback, TurnsWithTheBody) {
    const Asset still = with_partial_gloss();
    Asset turned = still;
    turned.moving().root_motion.resize(5);
    RigidTransform root;
    root.rotation = Eigen::AngleAxisd(0.8, Vec3d(1, 2, -1).normalized());
    root.translation = Vec3d(4, -2, 1);
    for (RigidTransform& of_pose : turned.moving().root_motion) of_pose = root;
    const LightCoefficients light = random_light(3, 7);
    const Vec3f eye(2, 2, 5);
    Playback one(std::make_shared<const Asset>(still)),
        other(std::make_shared<const Asset>(turned));
    one.set_light(DistantLight(light));
    one.set_eye(eye);
    one.update(3.0);
    other.set_light(DistantLight(turn(light, root.rotation.toRotationMatrix())));
    other.set_eye(root.to_scene(eye.cast<double>()).cast<float>());
    other.update(3.0);
    for (size_t v = 0; v < 4; ++v) {
        // Rotations of 9 coefficients round a few times more, and so does the place of the eye.
        expect_near_sum(other.radiance()[v], one.radiance()[v].cast<double>(), 100.0);
    }
}

}  // namespace
}  // namespace paim
