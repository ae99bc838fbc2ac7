// Which vertices go on shooting rays.
#include "compressor/bake/noise_target.h"

#include <gtest/gtest.h>

#include <array>

namespace paim {
namespace {

// Two triangles that share the edge 1–2, and a vertex of no face.
const Topology kMesh{5, {{0, 1, 2}, {2, 1, 3}}};

using Vertices = std::vector<uint32_t>;
using Energies = std::array<double, 5>;

Vertices above(const Energies& noise_energy, const std::array<uint64_t, 5>& num_rays,
               const Vertices& candidates = {0, 1, 2, 3, 4}) {
    return above_noise_target(kMesh, noise_energy, num_rays, 1.5, 1.0, candidates);
}

constexpr std::array<uint64_t, 5> kAlike{64, 64, 64, 64, 64};

TEST(NoiseTarget, IsMetByEqual) {
    EXPECT_EQ(above({1, 1, 1, 1, 1}, kAlike), Vertices{});
    EXPECT_EQ(above({1.001, 1.001, 1.001, 1.001, 1.001}, kAlike), (Vertices{0, 1, 2, 3, 4}));
}

TEST(NoiseTarget, IsThatOfTheNeighbours) {
    // Of 0 and 3 those are 1 and 2; of 1 and 2 each other, twice as two faces share the edge, 0 and
    // 3.
    EXPECT_EQ(above({0, 1.9, 0, 0, 0}, kAlike), Vertices{});
    EXPECT_EQ(above({0, 2.1, 0, 0, 0}, kAlike), (Vertices{0, 2, 3}));
    EXPECT_EQ(above({4.1, 0, 0, 0, 0}, kAlike), (Vertices{1, 2}));
    // 4 has none.
    EXPECT_EQ(above({0, 0, 0, 0, 1.5}, kAlike), Vertices{4});
}

TEST(NoiseTarget, NeighboursOfOtherCountsAreComparedAtTheVertexsOwn) {
    // At 64 rays 1 and 2 would have 4^1.5 = 8 times the squared error that they have at 256.
    const std::array<uint64_t, 5> num_rays{64, 256, 256, 64, 64};
    EXPECT_EQ(above({0, 0.126, 0.126, 0, 0}, num_rays), (Vertices{0, 3}));
    EXPECT_EQ(above({0, 0.124, 0.124, 0, 0}, num_rays), Vertices{});
}

TEST(NoiseTarget, NeighboursThatShotNothingAreNotAsked) {
    // Of 0 only 2 is left.
    const std::array<uint64_t, 5> num_rays{64, 0, 64, 64, 64};
    EXPECT_EQ(above({0, 0, 1.1, 0, 0}, num_rays, {0}), Vertices{0});
    EXPECT_EQ(above({0, 9, 0.9, 0, 0}, num_rays, {0}), Vertices{});
}

TEST(NoiseTarget, OnlyCandidatesAreAsked) {
    EXPECT_EQ(above({9, 9, 9, 9, 9}, kAlike, {0, 4}), (Vertices{0, 4}));
}

}  // namespace
}  // namespace paim
