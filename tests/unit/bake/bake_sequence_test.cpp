// Baking a sequence: every pose is that of the baker, also where an earlier run left gaps.
#include "compressor/bake/bake_sequence.h"

#include <gtest/gtest.h>

#include "paim/base/tbb_parallel.h"
#include "poses/octopus.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kPoses = 6;
const BakeOptions kOptions{2, 16, 1};

uint32_t bake_all(const PoseSource& source, const std::filesystem::path& directory) {
    uint32_t calls = 0;
    const auto count = [&](uint32_t p) { EXPECT_EQ(p, calls++); };
    const BakeSummary summary =
        bake_sequence(source, kOptions, "faces", directory, 0, kPoses - 1, count);
    EXPECT_EQ(calls, kPoses);
    EXPECT_EQ(summary.baked + summary.resumed, kPoses);
    return summary.baked;
}

void expect_poses_of_the_baker(const PoseSource& source, const std::filesystem::path& directory) {
    const BakeReader reader(directory);
    const TransferBaker baker(kOptions);
    for (uint32_t p = 0; p < kPoses; ++p) {
        const BakedPose expected = baker.bake(source.topology(), source.load_pose(p), p);
        const BakedPose found = reader.read_pose(p);
        EXPECT_EQ(found.positions, expected.positions) << p;
        EXPECT_EQ(found.transfer, expected.transfer) << p;
    }
}

TEST(BakeSequence, GivesThePosesOfTheBaker) {
    const PoseSet octopus = poses::make_octopus(1000, kPoses);
    for (const int num_threads : {1, 2}) {
        const TemporaryDirectory directory;
        const ThreadLimit limit(num_threads);
        EXPECT_EQ(bake_all(octopus, directory.path() / "o.bake"), kPoses);
        expect_poses_of_the_baker(octopus, directory.path() / "o.bake");
    }
}

TEST(BakeSequence, FillsTheGapsOfAnEarlierRun) {
    const PoseSet octopus = poses::make_octopus(1000, kPoses);
    const TemporaryDirectory directory;
    const auto bake = directory.path() / "o.bake";
    bake_all(octopus, bake);
    for (const uint32_t p : {0u, 2u, 3u, 5u}) std::filesystem::remove(bake_pose_file(bake, p));
    EXPECT_EQ(bake_all(octopus, bake), 4u);
    expect_poses_of_the_baker(octopus, bake);
    EXPECT_EQ(bake_all(octopus, bake), 0u);
}

// Another process that bakes a share of the same directory while this one runs.
class Meddler : public PoseSource {
  public:
    Meddler(const PoseSet& poses, std::filesystem::path bake, std::filesystem::path other)
        : poses_(poses), bake_(std::move(bake)), other_(std::move(other)) {}

    const Topology& topology() const override { return poses_.topology(); }
    const Albedo& albedo() const override { return poses_.albedo(); }
    uint32_t num_poses() const override { return poses_.num_poses(); }
    std::string pose_name(uint32_t p) const override { return poses_.pose_name(p); }
    uint64_t pose_checksum(uint32_t p) const override { return poses_.pose_checksum(p); }
    Pose load_pose(uint32_t p) const override {
        if (p == 2) std::filesystem::copy_file(bake_pose_file(other_, 2), bake_pose_file(bake_, 2));
        return poses_.load_pose(p);
    }

  private:
    const PoseSet& poses_;
    std::filesystem::path bake_, other_;
};

TEST(BakeSequence, IsNotConfusedByPosesThatAppearWhileItReadsThem) {
    const PoseSet octopus = poses::make_octopus(1000, kPoses);
    const TemporaryDirectory directory;
    const auto other = directory.path() / "other.bake";
    const auto bake = directory.path() / "o.bake";
    bake_all(octopus, other);
    const ThreadLimit limit(2);
    // Usually the pose is there before its turn comes, and is found instead of baked.
    EXPECT_GE(bake_all(Meddler(octopus, bake, other), bake), kPoses - 1);
    expect_poses_of_the_baker(octopus, bake);
}

}  // namespace
}  // namespace paim
