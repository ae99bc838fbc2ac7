// Where coordinates are counted from: the rule's borders, its rounding, and sizes at the ends of
// what floats hold.
#include "paim/mesh/origin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"

namespace paim {
namespace {

BoundsD box(const Vec3d& center, const Vec3d& size) {
    BoundsD bounds;
    bounds.extend(Vec3d(center - 0.5 * size));
    bounds.extend(Vec3d(center + 0.5 * size));
    return bounds;
}

TEST(Origin, IsZeroForOrdinaryMeshes) {
    EXPECT_EQ(choose_origin(BoundsD()), Vec3d::Zero());
    EXPECT_EQ(choose_origin(box({0, 0, 0}, {1, 1, 1})), Vec3d::Zero());
    // Diagonal 3; 16 of them are 48.
    EXPECT_EQ(choose_origin(box({48, 0, 0}, {1, 2, 2})), Vec3d::Zero());
    EXPECT_NE(choose_origin(box({0, 0, -48.01}, {1, 2, 2})), Vec3d::Zero());
    // A point has no size that says what is far.
    EXPECT_EQ(choose_origin(box({1e9, 0, 0}, {0, 0, 0})), Vec3d::Zero());
}

TEST(Origin, IsTheCentreToAPowerOfTwoBelowTheDiagonal) {
    // Diagonal 3, so multiples of 2.
    EXPECT_EQ(choose_origin(box({1000.7, -0.9, -3001.5}, {1, 2, 2})), Vec3d(1000, 0, -3002));
    EXPECT_FALSE(std::signbit(choose_origin(box({1000, -0.9, 0}, {1, 2, 2})).y()));
}

TEST(Origin, LeavesNoCoordinateAboveTheDiagonal) {
    RandomStream random(1);
    for (int j = 0; j < 1000; ++j) {
        const auto uniform = [&] { return 2.0 * random.uniform() - 1.0; };
        // From the least floats to the largest.
        const double scale = std::pow(10.0, 30.0 * uniform());
        const Vec3d size = scale * Vec3d(uniform(), uniform(), uniform()).cwiseAbs();
        const Vec3d far(uniform(), uniform(), uniform());
        const BoundsD bounds = box(1e6 * scale * far, size);
        const Vec3d origin = choose_origin(bounds);
        for (const Vec3d& corner : {bounds.lower, bounds.upper}) {
            EXPECT_LE((corner - origin).cwiseAbs().maxCoeff(), bounds.diagonal());
        }
    }
}

}  // namespace
}  // namespace paim
