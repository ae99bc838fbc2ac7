// Which vertices go on shooting rays.
#include "compressor/bake/noise_target.h"

#include <gtest/gtest.h>

#include <array>

namespace paim {
namespace {

// Two triangles that share the edge 1–2, and a vertex of no face.
const Topology kMesh{5, {{0, 1, 2}, {2, 1, 3}}};

using Vertices = std::vector<uint32_t>;
using Values = std::array<double, 5>;

std::vector<RayDemand> demands(const Values& noise_energy, const Values& information,
                               const Vertices& candidates = {0, 1, 2, 3, 4}) {
    return above_noise_target(Neighbours(kMesh), noise_energy, information, 1.5, 1.0, candidates);
}

Vertices above(const Values& noise_energy, const Values& information,
               const Vertices& candidates = {0, 1, 2, 3, 4}) {
    Vertices vertices;
    for (const RayDemand& demand : demands(noise_energy, information, candidates)) {
        vertices.push_back(demand.vertex);
    }
    return vertices;
}

constexpr Values kAlike{64, 64, 64, 64, 64};

TEST(NoiseTarget, IsMetByEqual) {
    EXPECT_EQ(above({1, 1, 1, 1, 1}, kAlike), Vertices{});
    EXPECT_EQ(above({1.001, 1.001, 1.001, 1.001, 1.001}, kAlike), (Vertices{0, 1, 2, 3, 4}));
}

TEST(NoiseTarget, IsThatOfTheNeighbours) {
    // Of 0 and 3 those are 1 and 2; of 1 and 2 each other, once though two faces share the edge, 0
    // and 3.
    EXPECT_EQ(above({0, 1.9, 0, 0, 0}, kAlike), Vertices{});
    EXPECT_EQ(above({0, 2.1, 0, 0, 0}, kAlike), (Vertices{0, 3}));
    EXPECT_EQ(above({0, 3.1, 0, 0, 0}, kAlike), (Vertices{0, 2, 3}));
    EXPECT_EQ(above({3.1, 0, 0, 0, 0}, kAlike), (Vertices{1, 2}));
    // 4 has none.
    EXPECT_EQ(above({0, 0, 0, 0, 1.5}, kAlike), Vertices{4});
}

TEST(NoiseTarget, NeighboursOfOtherRaysAreComparedAtTheVertexsOwn) {
    // With the information of 0 and 3, 1 and 2 would have 8 times the squared error that they have.
    const Values information{64, 512, 512, 64, 64};
    EXPECT_EQ(above({0, 0.126, 0.126, 0, 0}, information), (Vertices{0, 3}));
    EXPECT_EQ(above({0, 0.124, 0.124, 0, 0}, information), Vertices{});
}

TEST(NoiseTarget, AsksForTheInformationThatIsMissing) {
    // Nine times the squared error of the target: eight times the information is missing, 8 · 125,
    // which a set of 100 = 1000^(2/3) rays has.
    const std::vector<RayDemand> found = demands({0, 0, 0, 0, 9}, {125, 125, 125, 125, 125});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].vertex, 4u);
    EXPECT_NEAR(found[0].rays, 100.0, 1e-9);
}

TEST(NoiseTarget, NeighboursThatShotNothingAreNotAsked) {
    // Of 0 only 2 is left.
    const Values information{64, 0, 64, 64, 64};
    EXPECT_EQ(above({0, 0, 1.1, 0, 0}, information, {0}), Vertices{0});
    EXPECT_EQ(above({0, 9, 0.9, 0, 0}, information, {0}), Vertices{});
}

TEST(NoiseTarget, OnlyCandidatesAreAsked) {
    EXPECT_EQ(above({9, 9, 9, 9, 9}, kAlike, {0, 4}), (Vertices{0, 4}));
}

TEST(Neighbours, OpenFractionsAreTheMeanOfThoseWithRays) {
    const Neighbours neighbours(kMesh);
    const std::array<uint64_t, 5> num_rays{10, 20, 0, 40, 50};
    const std::array<uint64_t, 5> num_occluded{10, 5, 0, 20, 50};
    // Of 1 those are 0 (closed), 2 (without rays) and 3 (half open); not itself.
    EXPECT_DOUBLE_EQ(open_fraction_around(neighbours, 1, num_rays, num_occluded), 0.25);
    EXPECT_DOUBLE_EQ(open_fraction_around(neighbours, 0, num_rays, num_occluded), 0.75);
    EXPECT_DOUBLE_EQ(open_fraction_around(neighbours, 4, num_rays, num_occluded), 1.0);
}

}  // namespace
}  // namespace paim
