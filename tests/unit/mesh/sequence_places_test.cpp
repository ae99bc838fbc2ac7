// Places that vertices share in all poses: exact ones, and what outliers do to them.
#include "paim/mesh/sequence_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "paim/mesh/outliers.h"
#include "paim/mesh/places.h"

namespace paim {
namespace {

using SharedPlaces = std::vector<uint32_t>;

// A square of 8 x 8 vertices, of size 1.4, and copies of some of its vertices.
class PosesWithCopies {
  public:
    PosesWithCopies(size_t num_poses, const std::vector<uint32_t>& copies) {
        std::vector<Vec3d> pose;
        for (int i = 0; i < 64; ++i) pose.emplace_back(i % 8 / 7.0, i / 8 / 7.0, 0.0);
        for (const uint32_t v : copies) pose.push_back(Vec3d(pose[v]));
        poses_.assign(num_poses, pose);
    }
    Vec3d& at(size_t pose, size_t v) { return poses_[pose][v]; }

    // Of the copies; v: of its own.
    SharedPlaces places(bool backwards = false) const {
        std::vector<uint32_t> corners(poses_[0].size());
        std::iota(corners.begin(), corners.end(), 0u);
        const auto bounds_of = [&](const std::vector<Vec3d>& pose) {
            BoundsD bounds;
            bounds.extend(pose);
            return usual_bounds(pose, corners, bounds);
        };
        const auto num_poses = static_cast<uint32_t>(poses_.size());
        const std::vector<uint32_t> chosen = reference_poses(num_poses);
        std::vector<SequencePlaces::Reference> references;
        for (const uint32_t p : chosen) references.push_back({poses_[p], bounds_of(poses_[p])});
        SequencePlaces sequence(num_poses, references);
        for (uint32_t j = 0; j < num_poses; ++j) {
            const uint32_t p = backwards ? num_poses - 1 - j : j;
            if (std::count(chosen.begin(), chosen.end(), p) > 0) continue;
            sequence.add(poses_[p], bounds_of(poses_[p]));
        }
        SharedPlaces places = sequence.finish();
        if (places.empty()) places = corners;
        return {places.begin() + 64, places.end()};
    }

  private:
    std::vector<std::vector<Vec3d>> poses_;
};

TEST(SequencePlaces, AreNotPartedByAnOutlierInAnyPose) {
    for (const size_t num_poses : {3, 4, 7, 30}) {
        for (size_t p = 0; p < num_poses; ++p) {
            for (const size_t bad : {9, 64}) {  // the vertex, or its copy
                for (const double far : {2.0, 9.0, 5000.0, 1e30}) {
                    PosesWithCopies poses(num_poses, {9, 10});
                    poses.at(p, bad) += Vec3d(far, -far, 0.5);
                    EXPECT_EQ(poses.places(), (SharedPlaces{9, 10})) << num_poses << ' ' << p;
                }
            }
        }
    }
}

TEST(SequencePlaces, ArePartedByLessThanTheMesh) {
    for (const size_t num_poses : {1, 2, 3, 4, 30}) {
        for (size_t p = 0; p < num_poses; ++p) {
            for (const double near : {1e-9, 0.1, 1.0}) {
                PosesWithCopies poses(num_poses, {9, 10});
                poses.at(p, 64).z() += near;
                EXPECT_EQ(poses.places(), (SharedPlaces{64, 10})) << num_poses << ' ' << p;
            }
        }
    }
    // An outlier elsewhere, or of its own, does not change that.
    PosesWithCopies poses(9, {9, 10});
    poses.at(4, 64).z() += 0.1;
    poses.at(4, 20).z() += 5000.0;
    poses.at(5, 64).z() += 5000.0;
    EXPECT_EQ(poses.places(), (SharedPlaces{64, 10}));
}

TEST(SequencePlaces, ArePartedByTwoPoses) {
    PosesWithCopies poses(2, {9});
    poses.at(1, 64).z() = 5000.0;
    EXPECT_EQ(poses.places(), (SharedPlaces{64}));
}

TEST(SequencePlaces, ArePartedByWhatIsAwayTooOften) {
    EXPECT_EQ(most_outliers_of_vertex(2), 0u);
    EXPECT_EQ(most_outliers_of_vertex(3), 1u);
    EXPECT_EQ(most_outliers_of_vertex(16), 4u);
    for (const size_t away : {4, 5}) {
        PosesWithCopies poses(16, {9, 9, 9});
        for (size_t p = 1; p <= away; ++p) {
            for (const size_t v : {65, 66}) poses.at(p, v).z() += 100.0;
        }
        // What goes away together stays together.
        EXPECT_EQ(poses.places(), (away == 4 ? SharedPlaces{9, 9, 9} : SharedPlaces{9, 65, 65}));
    }
}

// A broken pose may have several vertices at one place.
TEST(SequencePlaces, OfOutliersAtOnePlaceAreTheirOwn) {
    for (const size_t p : {0, 1, 3}) {
        PosesWithCopies poses(9, {9, 30, 50});
        for (const size_t v : {9, 65, 66}) poses.at(p, v) = Vec3d(-500, 0, 0);
        EXPECT_EQ(poses.places(), (SharedPlaces{9, 30, 50})) << p;
    }
}

// Vertex 9 is of the upper lip, its copies are two of the lower one.
TEST(SequencePlaces, LipsPartAndTheirSeamsDoNot) {
    for (const size_t first_open : {3, 4}) {  // pose 3 is a reference
        for (const size_t bad : {9, 64, 65}) {
            for (size_t p = 0; p < 9; ++p) {
                // Where the references do not tell the lips apart, a copy is taken to lie with
                // vertex 9 in all poses, which is wrong in those that are open.
                if (bad > 9 && p >= first_open && p <= (first_open == 3 ? 3 : 5)) continue;
                PosesWithCopies poses(9, {9, 9});
                for (size_t open = first_open; open <= 5; ++open) {
                    for (const size_t v : {64, 65}) poses.at(open, v).z() -= 0.1;
                }
                poses.at(p, bad).x() += 5000.0;
                EXPECT_EQ(poses.places(), (SharedPlaces{64, 64})) << first_open << p << bad;
            }
        }
    }
    // They part in the very pose in which the vertex with which they usually lie is far away.
    PosesWithCopies poses(9, {9, 9});
    poses.at(4, 9).x() += 5000.0;
    poses.at(4, 65).z() += 0.1;
    EXPECT_EQ(poses.places(), (SharedPlaces{9, 65}));
}

TEST(SequencePlaces, AreThoseOfEveryPoseInAnyOrder) {
    std::mt19937 random(7);
    std::vector<uint32_t> copies(300);
    for (uint32_t& v : copies) v = random() % 64;
    PosesWithCopies poses(20, copies);
    for (int i = 0; i < 200; ++i) poses.at(random() % 20, 64 + random() % 300).z() += 0.01;
    SharedPlaces expected;
    for (size_t p = 0; p < 20; ++p) {
        std::vector<Vec3d> pose;
        for (size_t v = 0; v < 364; ++v) pose.push_back(poses.at(p, v));
        expected = first_at_position(pose, expected);
    }
    expected.erase(expected.begin(), expected.begin() + 64);
    EXPECT_EQ(poses.places(), expected);
    EXPECT_EQ(poses.places(true), expected);
    EXPECT_EQ(std::count(expected.begin(), expected.end(), copies[0]) > 0, true);
}

// Vertices that touch in one pose only, or a mesh that is a point there, do not matter.
TEST(SequencePlaces, AreNotThoseOfVerticesThatTouch) {
    for (const bool touch : {false, true}) {
        for (size_t first = 0; first < 9; ++first) {
            for (size_t p = 0; p < 9; ++p) {
                if (p == first) continue;
                PosesWithCopies poses(9, {9, 20});
                for (size_t v = 0; v < 66; ++v) {
                    if (!touch || v == 9 || v == 64) poses.at(first, v) = poses.at(first, 3);
                }
                poses.at(p, 64).y() = -500.0;
                EXPECT_EQ(poses.places(), (SharedPlaces{9, 20})) << touch << first << p;
            }
        }
    }
}

// Its size is that of the poses, not of the first one.
TEST(SequencePlaces, OfAMeshThatGrowsFromAPoint) {
    PosesWithCopies poses(20, {9, 10});
    for (size_t p = 0; p < 20; ++p) {
        for (size_t v = 0; v < 66; ++v) poses.at(p, v) *= static_cast<double>(p) / 19.0;
    }
    poses.at(9, 64).x() = 100.0;
    poses.at(19, 65).z() = 1.1;  // less than the mesh there, more than most of the time
    EXPECT_EQ(poses.places(), (SharedPlaces{9, 65}));
}

}  // namespace
}  // namespace paim
