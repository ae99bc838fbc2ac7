// A body that travels and turns, from its poses through bake, encoder, file and playback, against
// the same body on the spot.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/encode.h"
#include "compressor/encode/search/target_encode.h"
#include "compressor/scene/floor.h"
#include "compressor/scene/root_motion.h"
#include "compressor/scene/still_mesh.h"
#include "paim/codec/playback.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/asset_error.h"
#include "poses/octopus.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kPoses = 6;

// The octopus, whose pose p is moved by a transform.
PoseSet moved(const std::function<RigidTransform(uint32_t)>& at, bool stiff = false) {
    const PoseSet octopus = poses::make_octopus(1000, kPoses);
    std::vector<std::vector<Vec3f>> positions(kPoses);
    for (uint32_t p = 0; p < kPoses; ++p) {
        for (const Vec3f& point : octopus.load_pose(stiff ? 0 : p).positions) {
            positions[p].push_back(at(p).to_scene(point.cast<double>()).cast<float>());
        }
    }
    return PoseSet(octopus.topology(), positions);
}

RigidTransform walk(uint32_t p) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(0.9 * p, Vec3d::UnitY())),
            Vec3d(20.0 * p, 0.1 * p, -7.0 * p)};
}

// With a vertex behind all others that no face has, at the same place of the scene in all poses.
PoseSet with_isolated_vertex(const PoseSet& body) {
    Topology topology = body.topology();
    ++topology.num_vertices;
    std::vector<std::vector<Vec3f>> positions;
    for (uint32_t p = 0; p < kPoses; ++p) {
        positions.push_back(body.load_pose(p).positions);
        positions.back().push_back(Vec3f(70, -30, 5));
    }
    return PoseSet(topology, positions);
}

class RootMotionRoad : public testing::Test {
  protected:
    BakeReader bake(const PoseSource& source, RootMotionChoice choice, const std::string& name,
                    const Surroundings& surroundings = {}, uint32_t bounces = 0,
                    const PoseSource* body = nullptr) {
        const auto path = directory_ / name;
        BakeOptions options{4, 64, 1};
        options.bounces = bounces;
        bake_sequence(
            source, options, "faces", path, 0, kPoses - 1, [](uint32_t) {}, surroundings,
            find_root_motion(body ? *body : source, choice, {},
                             body ? LocalOrigin::reference : LocalOrigin::centre));
        return BakeReader(path);
    }

    Asset encode_by_default(const BakeReader& reader) {
        EncodeOptions options;
        options.measure = true;
        summary_ = encode(reader, options, directory_ / "x.paim");
        return read_paim(directory_ / "x.paim");
    }

    // Of the same poses under the same light, coded in local coordinates and in the scene's.
    // among_still_meshes  with a wall next to the path, off which light bounces
    void expect_same_picture(const PoseSource& poses, const PoseSource& body,
                             bool among_still_meshes) {
        Surroundings surroundings;
        if (among_still_meshes) {
            surroundings.still_mesh.add(
                PoseSet({4, {{0, 1, 2}, {0, 2, 3}}},
                        {{{-40, -9, -60}, {200, -9, -60}, {200, 9, -60}, {-40, 9, -60}}}));
        }
        const uint32_t bounces = among_still_meshes ? 1 : 0;
        EncodeOptions all;
        all.geometry.kind = all.transfer.kind = ComponentChoice::Kind::all;
        std::vector<std::shared_ptr<const Asset>> assets;
        for (const RootMotionChoice choice : {RootMotionChoice::none, RootMotionChoice::rigid}) {
            const std::string name = std::string(among_still_meshes ? "still" : "alone") +
                                     (choice == RootMotionChoice::none ? "_n.bake" : "_r.bake");
            encode(bake(poses, choice, name, surroundings, bounces, &body), all,
                   directory_ / "x.paim");
            assets.push_back(std::make_shared<const Asset>(read_paim(directory_ / "x.paim")));
        }
        EXPECT_TRUE(assets[0]->moving().root_motion.empty());
        EXPECT_EQ(assets[1]->moving().root_motion.size(), kPoses);
        LightCoefficients light{4, std::vector<Vec3f>(16, Vec3f(0.1f, 0.2f, -0.1f))};
        light.values[0] = {2, 2, 2};
        light.values[3] = {0.5f, -1, 0};
        Playback scene(assets[0]), local(assets[1]);
        for (Playback* playback : {&scene, &local}) playback->set_light(DistantLight(light));
        for (uint32_t p = 0; p < kPoses; ++p) {
            for (Playback* playback : {&scene, &local}) playback->update(p);
            for (size_t j = 0; j < scene.positions().size(); ++j) {
                ASSERT_NEAR(local.positions()[j], scene.positions()[j], 1e-4f) << p << ' ' << j;
            }
            for (size_t v = 0; v < scene.radiance().size(); ++v) {
                ASSERT_LT((local.radiance()[v] - scene.radiance()[v]).norm(), 1e-4f)
                    << p << ' ' << v;
            }
        }
        // Positions before they are moved are small.
        EXPECT_LT(std::abs(local.local_positions()[0]), 5.0f);
        EXPECT_TRUE(local.root().turns());
    }

    TemporaryDirectory directory_;
    EncodeSummary summary_;
};

TEST_F(RootMotionRoad, NeedsNoComponentForARigidBody) {
    const PoseSet body = moved(&walk, true);
    const BakeReader reader = bake(body, RootMotionChoice::automatic, "r.bake");
    ASSERT_EQ(reader.identity().root_motion.size(), kPoses);
    EncodeTarget target;
    target.transfer_error = 0.25;
    const TargetSummary summary = encode_to_target(reader, {}, target, directory_ / "t.paim");
    EXPECT_EQ(summary.geometry_components, 0u);
    EXPECT_EQ(summary.chosen().components, 0u);
    // Neither does it by default.
    encode_by_default(reader);
    EXPECT_EQ(summary_.geometry_components, 0u);
    EXPECT_EQ(summary_.transfer_components, 0u);
    // It plays where it was.
    Playback playback(std::make_shared<const Asset>(read_paim(directory_ / "t.paim")));
    for (uint32_t p = 0; p < kPoses; ++p) {
        playback.update(p);
        const Pose pose = body.load_pose(p);
        const auto planes = playback.positions();
        // Vertices of the file are in another order; the centre is not.
        Vec3d got = Vec3d::Zero(), expected = Vec3d::Zero();
        const size_t count = pose.positions.size();
        for (size_t v = 0; v < count; ++v) {
            expected += pose.positions[v].cast<double>();
            got +=
                Vec3d(double{planes[v]}, double{planes[count + v]}, double{planes[2 * count + v]});
        }
        EXPECT_LT((got - expected).norm() / static_cast<double>(count), 2e-3) << p;
    }
}

// The arms of a travelling octopus wave as they do on the spot.
TEST_F(RootMotionRoad, KeepsWhatMovesApartFromThePath) {
    const BakeReader still = bake(moved([](uint32_t) { return RigidTransform{}; }),
                                  RootMotionChoice::automatic, "s.bake");
    EXPECT_TRUE(still.identity().root_motion.empty());
    encode_by_default(still);
    const double on_the_spot = summary_.measured->geometry.relative_rms();
    const BakeReader travelling = bake(moved(&walk), RootMotionChoice::automatic, "w.bake");
    ASSERT_EQ(travelling.identity().root_motion.size(), kPoses);
    encode_by_default(travelling);
    EXPECT_LT(summary_.measured->geometry.relative_rms(), 1.5 * on_the_spot + 1e-6);
    const BakeReader in_the_scene = bake(moved(&walk), RootMotionChoice::none, "n.bake");
    encode_by_default(in_the_scene);
    EXPECT_GT(summary_.measured->geometry.relative_rms(), 5.0 * on_the_spot);
}

// The octopus, as if each pose had been read from 200,000 of its lengths farther on.
class Traveller : public PoseSource {
  public:
    const Topology& topology() const override { return octopus_.topology(); }
    const Albedo& albedo() const override { return octopus_.albedo(); }
    uint32_t num_poses() const override { return kPoses; }
    Vec3d pose_offset(uint32_t p) const override { return Vec3d(2e5 * p, 0.0, -1e5 * p); }
    std::string pose_name(uint32_t p) const override { return octopus_.pose_name(p); }
    uint64_t pose_checksum(uint32_t p) const override { return octopus_.pose_checksum(p); }
    Pose load_pose(uint32_t p) const override { return octopus_.load_pose(p); }

  private:
    PoseSet octopus_ = poses::make_octopus(1000, kPoses);
};

TEST_F(RootMotionRoad, BakesATravellerAsOnTheSpot) {
    const Traveller traveller;
    const BakeReader far = bake(traveller, RootMotionChoice::automatic, "f.bake");
    const BakeReader near =
        bake(poses::make_octopus(1000, kPoses), RootMotionChoice::translation, "n.bake");
    ASSERT_EQ(far.identity().root_motion.size(), kPoses);
    const double step = far.identity().root_motion[5].translation.x() -
                        near.identity().root_motion[5].translation.x();
    EXPECT_NEAR(step, 1e6, 1e-3);
    for (uint32_t p = 0; p < kPoses; ++p) {
        EXPECT_EQ(far.read_pose(p).transfer, near.read_pose(p).transfer) << p;
    }
}

// A vertex without faces goes along with the body, and costs no component.
TEST_F(RootMotionRoad, LeavesIsolatedVerticesAtRest) {
    const PoseSet body = moved(&walk);
    const BakeReader reader =
        bake(with_isolated_vertex(body), RootMotionChoice::automatic, "i.bake");
    const uint32_t isolated = body.topology().num_vertices;
    ASSERT_EQ(reader.identity().root_motion.size(), kPoses);
    for (uint32_t p = 0; p < kPoses; ++p) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const auto at = [&](uint32_t pose) {
                return reader.read_pose(pose).positions[axis * (isolated + 1) + isolated];
            };
            EXPECT_EQ(at(p), at(0)) << p;
            EXPECT_LT(std::abs(at(p)), 5.0f);
        }
    }
}

// The same body under the same light, coded in local coordinates and in the scene's.
TEST_F(RootMotionRoad, ShowsTheSamePicture) {
    const PoseSet body = moved(&walk);
    for (const bool among_still_meshes : {false, true}) {
        SCOPED_TRACE(among_still_meshes);
        expect_same_picture(body, body, among_still_meshes);
    }
}

TEST_F(RootMotionRoad, ShowsTheSamePictureOnAFloor) {
    const PoseSet body = moved(&walk);
    const PosesOnFloor on_floor(body, bounds_of(body), {500, Vec3f::Constant(0.8f)});
    expect_same_picture(on_floor, body, false);
}

// Files for a target have vertices in another order, isolated ones last.
TEST_F(RootMotionRoad, KeepsTheFloorBehindTheBodyInFiles) {
    const PoseSet walking = moved(&walk);
    const PoseSet body = with_isolated_vertex(walking);
    const PosesOnFloor on_floor(body, bounds_of(body), {300, Vec3f::Constant(0.8f)});
    const BakeReader reader = bake(on_floor, RootMotionChoice::automatic, "f.bake", {}, 0, &body);
    ASSERT_EQ(reader.identity().num_following, body.topology().num_vertices);
    EncodeTarget target;
    target.transfer_error = 0.25;
    encode_to_target(reader, {}, target, directory_ / "t.paim");
    const Asset asset = read_paim(directory_ / "t.paim");
    EXPECT_EQ(asset.moving().num_following, walking.topology().num_vertices);
    EXPECT_EQ(asset.moving().topology.num_triangles_before(asset.moving().num_following),
              walking.topology().triangles.size());
}

}  // namespace
}  // namespace paim
