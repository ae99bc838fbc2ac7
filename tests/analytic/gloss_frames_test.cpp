// Glossy transfer in the frames of vertices: the same radiance as in the axes of the pose, and what it
// loses where frames come from other positions.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "compressor/bake/bake_sequence.h"
#include "compressor/bake/gloss_to_frames.h"
#include "compressor/bake/transfer_baker.h"
#include "paim/base/seed.h"
#include "paim/codec/gloss_frames.h"
#include "paim/format/bake/baked_frames.h"
#include "paim/mesh/planes.h"
#include "paim/metrics/frame_error.h"
#include "paim/sh/rotate.h"
#include "poses/octopus.h"
#include "tests/gloss_light.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kPoses = 3;
const Materials kGlossy{{{"phong:0.5,10", Vec3f::Ones()}}, {1}};

BakeOptions make_options() {
    BakeOptions options{3, 64, 1};
    options.gloss_in_bands = 3;
    options.gloss_out_bands = 4;
    return options;
}

// A glossy octopus whose normals are those of its faces, or lean to one side of the surface.
class GlossyOctopus : public PoseSource {
  public:
    explicit GlossyOctopus(bool leaning)
        : poses_(poses::make_octopus(1000, kPoses)),
          frames_(poses_.topology(), poses_.load_pose(0).positions),
          leaning_(leaning) {}

    const Topology& topology() const override { return poses_.topology(); }
    const Albedo& albedo() const override { return poses_.albedo(); }
    const Materials& materials() const override { return kGlossy; }
    uint32_t num_poses() const override { return kPoses; }
    std::string pose_name(uint32_t p) const override { return poses_.pose_name(p); }
    uint64_t pose_checksum(uint32_t p) const override { return poses_.pose_checksum(p); }
    Pose load_pose(uint32_t p) const override {
        Pose pose = poses_.load_pose(p);
        const auto frames = frames_.at(pose.positions, pose.normals);
        for (size_t v = 0; leaning_ && v < frames.size(); ++v) {
            pose.normals[v] = frames[v] * Vec3f(0.3f, -0.2f, 1.0f).normalized();
        }
        return pose;
    }

  private:
    PoseSet poses_;
    TangentFrames frames_;
    bool leaning_;
};

class GlossFramesOfBakes : public testing::Test {
  protected:
    BakeReader bake(const PoseSource& poses) const {
        const auto path = directory_ / "x.bake";
        std::filesystem::remove_all(path);
        bake_sequence(poses, make_options(), "faces", path, 0, kPoses - 1, [](uint32_t) {});
        return BakeReader(path);
    }

    TemporaryDirectory directory_;
};

// All poses, as a first one and the differences to it.
LowRank positions_of(const std::vector<std::vector<float>>& poses) {
    LowRank matrix;
    matrix.num_planes = 3;
    matrix.num_points = static_cast<uint32_t>(poses[0].size() / 3);
    matrix.num_poses = static_cast<uint32_t>(poses.size());
    matrix.num_components = matrix.num_poses - 1;
    matrix.mean = poses[0];
    for (uint32_t k = 1; k < matrix.num_poses; ++k) {
        std::vector<float> difference(poses[k].size());
        for (size_t j = 0; j < difference.size(); ++j) difference[j] = poses[k][j] - poses[0][j];
        matrix.components.push_back(std::move(difference));
        for (uint32_t p = 0; p < matrix.num_poses; ++p) {
            matrix.weights.push_back(p == k ? 1.0f : 0.0f);
        }
        matrix.singular_values.push_back(1.0);
    }
    return matrix;
}

std::vector<std::vector<float>> baked_positions(const BakeReader& gloss) {
    std::vector<std::vector<float>> poses;
    for (uint32_t p = 0; p < gloss.num_poses(); ++p) poses.push_back(gloss.read_pose(p).positions);
    return poses;
}

std::vector<uint32_t> all_rows(const BakeReader& gloss) {
    std::vector<uint32_t> rows(gloss.identity().num_vertices);
    std::iota(rows.begin(), rows.end(), 0u);
    return rows;
}

double sum_of_squares(std::span<const float> values) {
    double sum = 0.0;
    for (const float value : values) sum += double{value} * double{value};
    return sum;
}

TEST_F(GlossFramesOfBakes, ShowTheSameInEveryDirection) {
    const GlossyOctopus poses(true);
    const TransferBaker baker(make_options(), {}, {}, kGlossy);
    const TransferLayout in_pose = *baker.gloss_layout(), in_frames = in_pose.in_frames();
    EXPECT_EQ(in_pose.num_planes(), 16u * 9u);
    EXPECT_EQ(in_frames.num_planes(), 10u * 9u);
    const RowFrames row_frames(poses.topology(), kGlossy, to_planes(poses.load_pose(0).positions));
    const Pose pose = poses.load_pose(1);
    const BakedPose before = baker.bake(poses.topology(), pose, 1);
    BakedPose after = before;
    const auto frames = row_frames.at(before);
    gloss_to_frames(in_frames, frames, after);
    EXPECT_EQ(after.statistics.gloss_rms, rms_by_band(in_frames, after.gloss));
    RandomStream random(3);
    std::vector<double> light(9);
    for (double& value : light) value = 2.0 * random.uniform() - 1.0;
    for (const auto member : {&BakedPose::gloss, &BakedPose::gloss_noise}) {
        // Nothing is lost: coefficients that are left out were zero.
        const double energy = sum_of_squares(before.*member);
        EXPECT_NEAR(sum_of_squares(after.*member), energy, 1e-5 * energy);
        for (size_t r = 0; r < frames.size(); r += 7) {
            const Vec3d v =
                Vec3d(2.0 * random.uniform() - 1.0, random.uniform(), 2.0 * random.uniform() - 1.0)
                    .normalized();
            const Vec3d in_frame = frames[r].transpose().cast<double>() * v;
            // Some hundred products of floats of about 1.
            EXPECT_NEAR(gloss_radiance(in_frames, after.*member, r, light, in_frame),
                        gloss_radiance(in_pose, before.*member, r, light, v), 2e-5);
        }
    }
}

// Frames of the baked positions are those of the bake, also where normals are others than those of the
// faces: turns make up for these.
TEST_F(GlossFramesOfBakes, AreKnownFromPositionsAndTurns) {
    for (const bool leaning : {false, true}) {
        const BakeReader gloss = bake(GlossyOctopus(leaning)).gloss();
        const LowRank positions = positions_of(baked_positions(gloss));
        Asset asset;
        asset.moving().topology = gloss.topology();
        asset.moving().layout = gloss.identity().layout;
        asset.moving().positions = positions;
        set_frame_turns(gloss, asset);
        EXPECT_EQ(asset.moving().frame_turns.num_points > 0, leaning);
        const BandPower flat = BandPower::flat(3);
        const FrameError error = measure_frames(gloss, 0, positions, all_rows(gloss), flat);
        // Turns are rounded to 1e-4, and normals to floats.
        EXPECT_LT(error.relative_rms, 1e-3);
        EXPECT_LT(error.worst_row, 1e-2);
    }
}

TEST_F(GlossFramesOfBakes, HaveTheErrorOfTurnedTransfer) {
    const BakeReader gloss = bake(GlossyOctopus(false)).gloss();
    std::vector<std::vector<float>> moved = baked_positions(gloss);
    RandomStream random(9);
    for (size_t p = 1; p < moved.size(); ++p) {
        for (float& x : moved[p]) x += static_cast<float>(0.02 * (random.uniform() - 0.5));
    }
    const LowRank positions = positions_of(moved);
    const BandPower power{"test", {1.0, 0.5, 0.25}, 0.0};
    const FrameError error = measure_frames(gloss, 0, positions, all_rows(gloss), power);

    const TransferLayout layout = gloss.identity().layout;
    const size_t num_rows = gloss.identity().num_vertices;
    const GlossFrames of_file(gloss.topology(), moved[0], {});
    const BakedFrames of_bake(gloss, 0);
    double squared = 0.0, energy = 0.0;
    for (uint32_t p = 0; p < kPoses; ++p) {
        const BakedPose pose = gloss.read_pose(p);
        const auto got = of_file.at(moved[p]), wanted = of_bake.at(p);
        for (size_t r = 0; r < num_rows; ++r) {
            const sh::Rotation one(4, got[r].cast<double>()), other(4, wanted[r].cast<double>());
            for (uint32_t i = 0; i < 9; ++i) {
                std::vector<double> local(16, 0.0), a(16), b(16);
                for (uint32_t k = 0; k < 10; ++k) {
                    local[static_cast<size_t>(sh::even_coefficient(static_cast<int>(k)))] =
                        pose.transfer[layout.plane(0, i, k) * num_rows + r];
                }
                one.apply(std::span<const double>(local), std::span(a));
                other.apply(std::span<const double>(local), std::span(b));
                const double weight = power.weight(layout.input_band(i));
                for (size_t o = 0; o < 16; ++o) {
                    squared += weight * (a[o] - b[o]) * (a[o] - b[o]);
                    energy += weight * b[o] * b[o];
                }
            }
        }
    }
    const double expected = std::sqrt(squared / energy);
    EXPECT_GT(expected, 0.03);
    EXPECT_NEAR(error.relative_rms, expected, 1e-6 * expected);
    EXPECT_GT(error.worst_row, error.relative_rms);
}

}  // namespace
}  // namespace paim
