// Colour spaces against published matrices and against what any of them must keep.
#include "paim/image/chromaticities.h"

#include <gtest/gtest.h>

#include <limits>

#include "paim/base/seed.h"

namespace paim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

const Chromaticities kAp0{{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, {0.32168, 0.33767}};
const Chromaticities kAp1{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};
const Chromaticities kRec2020{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};

void expect_near(const Matrix3d& got, const Matrix3d& expected, double tolerance) {
    EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), tolerance) << got;
}

// ITU-R BT.2087-0, Annex 2, to its four digits.
TEST(Chromaticities, Rec2020IsThePublishedMatrix) {
    Matrix3d expected;
    expected << 1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006, 1.1187;
    expect_near(*rec709_from(kRec2020), expected, 1e-4);
}

// Worked out apart, from the closed form of OpenEXR's RGBtoXYZ() and Bradford's matrix.
TEST(Chromaticities, AcesHasItsWhiteAdapted) {
    Matrix3d ap0, ap1;
    ap0 << 2.5217, -1.1341, -0.3876, -0.2765, 1.3727, -0.0962, -0.0154, -0.1530, 1.1684;
    ap1 << 1.7051, -0.6218, -0.0833, -0.1303, 1.1408, -0.0105, -0.0240, -0.1290, 1.1530;
    expect_near(*rec709_from(kAp0), ap0, 1e-4);
    expect_near(*rec709_from(kAp1), ap1, 1e-4);
}

TEST(Chromaticities, GreyStaysGrey) {
    RandomStream random(stream_key(5, 0, 0));
    for (int i = 0; i < 100; ++i) {
        Chromaticities c = kRec2020;
        for (Vector2d* xy : {&c.red, &c.green, &c.blue, &c.white}) {
            *xy += 0.03 * (Vector2d(random.uniform(), random.uniform()) - Vector2d(0.5, 0.5));
        }
        const auto matrix = rec709_from(c);
        ASSERT_TRUE(matrix);
        EXPECT_LT((*matrix * Vector3d::Ones() - Vector3d::Ones()).norm(), 1e-13);
    }
    expect_near(*rec709_from(Chromaticities()), Matrix3d::Identity(), 1e-14);
}

TEST(Chromaticities, KnowsItsOwn) {
    EXPECT_TRUE(is_rec709(Chromaticities()));
    Chromaticities rounded;
    rounded.white = {0.313, 0.329};
    EXPECT_TRUE(is_rec709(rounded));
    rounded.green.y() = 0.61;
    EXPECT_FALSE(is_rec709(rounded));
    EXPECT_FALSE(is_rec709(kAp0));
}

TEST(Chromaticities, RefusesWhatIsNoColourSpace) {
    const auto refused = [](const auto& change) {
        Chromaticities c;
        change(c);
        return !rec709_from(c).has_value() && !is_rec709(c);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(refused([&](Chromaticities& c) { c.red.x() = nan; }));
    EXPECT_TRUE(refused([&](Chromaticities& c) { c.white.y() = inf; }));
    EXPECT_TRUE(refused([](Chromaticities& c) { c.red = c.green = c.blue = c.white = {0, 0}; }));
    EXPECT_TRUE(refused([](Chromaticities& c) { c.white.y() = 0.0; }));
    EXPECT_TRUE(refused([](Chromaticities& c) { c.white.y() = -0.3; }));
    EXPECT_TRUE(refused([](Chromaticities& c) { c.green = 0.5 * (c.red + c.blue); }));
    EXPECT_TRUE(refused([](Chromaticities& c) { c.white = {0.7, 0.3}; }));  // beyond red
    EXPECT_TRUE(refused([](Chromaticities& c) { c.blue = {1e30, 1e30}; }));
}

}  // namespace
}  // namespace paim
