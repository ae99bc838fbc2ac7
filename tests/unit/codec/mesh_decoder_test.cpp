// The decoder against the sum it stands for, and its limits.
#include "paim/codec/mesh_decoder.h"

#include <gtest/gtest.h>

#include <limits>

#include "paim/codec/rebuild_planes.h"
#include "tests/example_asset.h"

namespace paim {
namespace {

// Row r of column p, by definition, from the first K components.
float element(const LowRank& matrix, size_t row, size_t p, uint32_t num_components) {
    double value = matrix.mean[row];
    for (uint32_t k = 0; k < num_components; ++k) {
        value += static_cast<double>(matrix.components[k][row]) *
                 matrix.weights[size_t{k} * matrix.num_poses + p];
    }
    return static_cast<float>(value);
}

TEST(MeshDecoder, IsTheSumItStandsFor) {
    const Asset asset = make_example_asset(3, 3);
    const LowRank& transfer = asset.moving().transfer->matrix;
    MeshDecoder decoder(asset.moving());
    DecodedPose pose;
    for (uint32_t p = 0; p < asset.num_poses(); ++p) {
        decoder.decode(p, {}, pose);
        ASSERT_EQ(pose.positions.size(), 12u);
        ASSERT_EQ(pose.transfer.size(), 27u * 4);
        for (size_t row = 0; row < pose.positions.size(); ++row) {
            EXPECT_NEAR(pose.positions[row], element(asset.moving().positions, row, p, 3), 1e-6f);
        }
        for (size_t row = 0; row < pose.transfer.size(); ++row) {
            EXPECT_NEAR(pose.transfer[row], element(transfer, row, p, 3), 1e-6f);
        }
    }
}

TEST(MeshDecoder, ObeysLimits) {
    const Asset asset = make_example_asset(3, 3);
    MeshDecoder decoder(asset.moving());
    DecodedPose pose;
    decoder.decode(2.0, {1, 2, 2}, pose);
    EXPECT_EQ(pose.layout.in_bands, 2u);
    ASSERT_EQ(pose.transfer.size(), 3u * 4 * 4);
    EXPECT_NEAR(pose.positions[7], element(asset.moving().positions, 7, 2, 1), 1e-6f);
    // Plane 1·4+3 of the limited layout is plane 1·9+3 of the mesh's; vertex 2.
    EXPECT_NEAR(pose.transfer[(4 + 3) * 4 + 2],
                element(asset.moving().transfer->matrix, (9 + 3) * 4 + 2, 2, 2), 1e-6f);
}

TEST(MeshDecoder, KeepsAtLeastOneBand) {
    const Asset asset = make_example_asset(3, 1);
    DecodedPose pose;
    MeshDecoder(asset.moving()).decode(0.0, {.bands = 0}, pose);
    EXPECT_EQ(pose.layout.in_bands, 1u);
    EXPECT_EQ(pose.transfer.size(), 4u);
}

TEST(MeshDecoder, InterpolatesWeightsAndClampsTime) {
    const LowRank positions = make_example_asset().moving().positions;
    std::vector<float> weights;
    interpolate_weights(positions, 1.25, weights);
    for (uint32_t k = 0; k < 3; ++k) {
        const float* row = positions.weights.data() + k * 5;
        EXPECT_NEAR(weights[k], 0.75f * row[1] + 0.25f * row[2], 1e-6f);
    }
    interpolate_weights(positions, 99.0, weights);
    EXPECT_EQ(weights[0], positions.weights[4]);
    interpolate_weights(positions, -1.0, weights);
    EXPECT_EQ(weights[0], positions.weights[0]);
}

// After the last pose's weight lies the next component's first, which would show even if it were
// multiplied by zero.
TEST(MeshDecoder, ReadsNoWeightAfterTheLastPose) {
    LowRank matrix = make_example_asset(2, 1, 3, 2).moving().positions;
    const std::vector<float> last{matrix.weights[2], matrix.weights[5]};
    matrix.weights[3] = std::numeric_limits<float>::infinity();
    std::vector<float> weights;
    for (const double time : {2.0, 3.0}) {
        interpolate_weights(matrix, time, weights);
        EXPECT_EQ(weights, last) << time;
    }
}

}  // namespace
}  // namespace paim
