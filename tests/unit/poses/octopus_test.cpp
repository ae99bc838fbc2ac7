// The octopus: a closed smooth surface of the size asked for, that never runs through itself.
#include "poses/octopus.h"

#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "paim/base/tbb_parallel.h"
#include "poses/octopus_motion.h"
#include "poses/octopus_shape.h"
#include "tests/unit/poses/mesh_checks.h"

namespace paim::poses {
namespace {

class OctopusOfSize : public testing::TestWithParam<uint32_t> {};

TEST_P(OctopusOfSize, IsClosedOrientedAndInOnePiece) {
    const auto octopus = make_octopus_sequence(GetParam());
    const Topology& topology = octopus->topology();
    EXPECT_EQ(topology.num_vertices, GetParam());
    EXPECT_EQ(count_bad_edges(topology), 0);
    EXPECT_EQ(euler_characteristic(topology), 2);
    EXPECT_EQ(count_components(topology), 1u);
}

TEST_P(OctopusOfSize, HasSoundTrianglesInEveryPose) {
    const auto octopus = make_octopus_sequence(GetParam());
    constexpr uint32_t kNumPoses = 6;
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        const auto positions = octopus->positions(p, kNumPoses);
        ASSERT_EQ(positions.size(), GetParam());
        // The round cones and spheres that it is made of hold about 13; coarse meshes cut corners.
        const double volume = signed_volume(octopus->topology(), positions);
        EXPECT_GT(volume, 11.0) << "pose " << p;
        EXPECT_LT(volume, 14.0) << "pose " << p;
        // Half of a square has 0.87, a triangle five times as long as wide 0.34. Bending an arm of
        // radius r by κ stretches its outside by 1 + κr and squeezes its inside, up to 1.5 to 1.
        EXPECT_GT(worst_quality(octopus->topology(), positions), 0.2) << "pose " << p;
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, OctopusOfSize,
                         testing::Values(1000u, 1001u, 1537u, 2500u, 5000u, 9999u, 30000u));

TEST(Octopus, RefusesSizesOutOfRange) {
    for (const uint32_t num_vertices : {0u, 999u, 2'000'001u, 4'000'000'000u}) {
        try {
            make_octopus_sequence(num_vertices);
            FAIL() << num_vertices;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
            EXPECT_NE(std::string(error.what()).find("1000 to 2000000"), std::string::npos);
        }
    }
}

TEST(Octopus, IsTheSameOnAnyNumberOfThreads) {
    const auto make = [](int num_threads) {
        const ThreadLimit limit(num_threads);
        const auto octopus = make_octopus_sequence(3000);
        return std::pair{octopus->topology(), octopus->positions(3, 7)};
    };
    EXPECT_EQ(make(1), make(3));
}

TEST(Octopus, ReachesTheGroundAndHasColors) {
    const PoseSet octopus = make_octopus(3000, 8);
    float lowest = 1e9f;
    for (uint32_t p = 0; p < 8; ++p) {
        for (const Vec3f& position : octopus.load_pose(p).positions) {
            lowest = std::min(lowest, position.y());
        }
    }
    EXPECT_NEAR(lowest, 0.0f, 0.1f);
    ASSERT_EQ(octopus.albedo().values.size(), 3000u);
    for (const Vec3f& albedo : octopus.albedo().values) {
        EXPECT_TRUE((albedo.array() >= 0.0f).all() && (albedo.array() <= 1.0f).all());
    }
}

TEST(OctopusMotion, Loops) {
    const OctopusMotion first(0.0), after(2.0 * kPi);
    for (double s = 0.0; s < kArmLength; s += 0.1) {
        for (int arm = 0; arm < kNumArms; ++arm) {
            // Sines of an argument larger by 2π differ by its rounding, 1e-15; curves are of
            // length 5.
            EXPECT_LT((first.arm(arm).center(s) - after.arm(arm).center(s)).norm(), 1e-12);
        }
    }
}

TEST(OctopusMotion, LeavesArmsApartAndTheirLengthAlone) {
    constexpr double kStep = 0.05, kFreeOfWeb = 1.5;
    struct Sample {
        int arm;
        double s, radius;
        Vec3d center;
    };
    for (int moment = 0; moment < 103; ++moment) {
        const OctopusMotion motion(2.0 * kPi * moment / 103);
        std::vector<Sample> samples;
        for (int arm = 0; arm < kNumArms; ++arm) {
            for (double s = kFreeOfWeb; s <= kArmLength; s += kStep) {
                samples.push_back({arm, s, arm_radius(s), motion.arm(arm).center(s)});
            }
        }
        for (size_t i = 1; i < samples.size(); ++i) {
            if (samples[i].arm != samples[i - 1].arm) continue;
            // A chord is shorter than its arc by κ²h³/24, with κ < 5 per unit at the tip: 1.3e-4.
            EXPECT_NEAR((samples[i].center - samples[i - 1].center).norm(), kStep, 2e-4);
        }
        for (size_t i = 0; i < samples.size(); ++i) {
            for (size_t j = 0; j < i; ++j) {
                const Sample &a = samples[i], &b = samples[j];
                const double touching = a.radius + b.radius;
                // Parts of one arm that follow each other within half a turn are near by nature.
                if (a.arm == b.arm && std::abs(a.s - b.s) < kPi * touching) continue;
                ASSERT_GT((a.center - b.center).norm(), touching)
                    << "moment " << moment << ", arm " << a.arm << " at " << a.s << ", arm "
                    << b.arm << " at " << b.s;
            }
        }
    }
}

TEST(OctopusField, HasTheGradientOfItsValue) {
    constexpr double kStep = 1e-5;
    for (const Vec3d& point : {Vec3d(0.2, 3.0, 0.3), Vec3d(0.5, 1.1, 0.7), Vec3d(1.1, 0.2, 0.4),
                               Vec3d(2.0, -0.2, 0.8), Vec3d(-0.9, 0.3, -0.1)}) {
        const Vec3d gradient = octopus_field(point).gradient;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3d step = kStep * Vec3d::Unit(axis);
            // Central differences: h² times a third derivative below 1/blend² = 400, over 6.
            EXPECT_NEAR((octopus_field(point + step).value - octopus_field(point - step).value) /
                            (2.0 * kStep),
                        gradient[axis], 1e-7);
        }
    }
}

}  // namespace
}  // namespace paim::poses
