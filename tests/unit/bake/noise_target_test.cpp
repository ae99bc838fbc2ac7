// Which vertices go on shooting rays.
#include "compressor/bake/noise_target.h"

#include <gtest/gtest.h>

#include <array>

namespace paim {
namespace {

// Two triangles that share the edge 1–2, and a vertex of no face.
const Topology kMesh{5, {{0, 1, 2}, {2, 1, 3}}};

std::vector<uint32_t> above(const std::array<double, 5>& noise_energy,
                            std::vector<uint32_t> candidates = {0, 1, 2, 3, 4}) {
    return above_noise_target(kMesh, noise_energy, 1.0, candidates);
}

using Vertices = std::vector<uint32_t>;

TEST(NoiseTarget, IsMetByEqual) {
    EXPECT_EQ(above({1, 1, 1, 1, 1}), Vertices{});
}

TEST(NoiseTarget, OwnNoiseAboveItGoesOn) {
    EXPECT_EQ(above({0, 0, 0, 0, 1.5}), Vertices{4});
    // The mean of the neighbours 1, 2 of vertex 0 stays below.
    EXPECT_EQ(above({0, 1.5, 0, 0, 0}), Vertices{1});
}

TEST(NoiseTarget, NoisyNeighboursKeepAQuietVertexGoing) {
    // The others look quiet, but the mean over the neighbours of each is 3/2.
    EXPECT_EQ(above({0, 3, 0, 0, 0}), (Vertices{0, 1, 2, 3}));
}

TEST(NoiseTarget, OnlyCandidatesAreAsked) {
    EXPECT_EQ(above({9, 9, 9, 9, 9}, {0, 4}), (Vertices{0, 4}));
}

}  // namespace
}  // namespace paim
