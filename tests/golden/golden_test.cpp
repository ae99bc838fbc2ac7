// The bytes of the file format, version by version. A version's files stay readable for ever, and
// what is written today is exactly the newest golden file.
//
// PAIM_UPDATE_GOLDEN=1 writes the newest file anew; a change of format adds one and leaves the old
// alone.
#include <gtest/gtest.h>

#include <cstdlib>

#include "paim/base/file.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

const std::filesystem::path kNewest = std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1.paim";

Asset golden_asset() {
    Asset asset = make_example_asset(2, 1, 3, 2);
    asset.moving().transfer->matrix.precision = Precision::f16;
    return asset;
}

TEST(Golden, WritesTheNewestFileByteForByte) {
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) write_paim(kNewest, golden_asset());
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", golden_asset());
    EXPECT_EQ(read_file(directory / "x.paim", 1 << 20), read_file(kNewest, 1 << 20));
}

// What stands still came later, as sections that earlier readers pass over.
const std::filesystem::path kStill =
    std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1_scenery.paim";

Asset golden_asset_with_still() {
    const Asset asset = golden_asset();
    return with_still(asset, make_example_still(asset.moving().layout));
}

TEST(Golden, WritesWhatStandsStillByteForByte) {
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) {
        write_paim(kStill, golden_asset_with_still());
    }
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", golden_asset_with_still());
    EXPECT_EQ(read_file(directory / "x.paim", 1 << 20), read_file(kStill, 1 << 20));
}

TEST(Golden, ReadsWhatStandsStill) {
    const Asset asset = read_paim(kStill), expected = golden_asset_with_still();
    ASSERT_NE(asset.still(), nullptr);
    EXPECT_EQ(asset.still()->topology, expected.still()->topology);
    EXPECT_EQ(asset.still()->albedo.values, expected.still()->albedo.values);
    EXPECT_EQ(asset.still()->positions, expected.still()->positions);
    EXPECT_EQ(asset.still()->transfer->matrix, expected.still()->transfer->matrix);
}

// Integers of every kind. Read, not written: bytes depend on the version of Zstandard.
Asset golden_asset_of_integers() {
    Asset asset = make_clustered_example(3, 3, 2, true);
    asset.vertex_order = VertexOrder::cache;
    return with_still(asset, make_quantised_still(asset.moving().layout));
}

TEST(Golden, ReadsIntegers) {
    const std::filesystem::path file =
        std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1_integers.paim";
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) write_paim(file, golden_asset_of_integers());
    const Asset asset = read_paim(file), expected = golden_asset_of_integers();
    for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
        const LowRank& matrix = asset.moving().attribute(attribute);
        const LowRank& numbers = expected.moving().attribute(attribute);
        EXPECT_EQ(matrix.mean, numbers.mean);
        EXPECT_EQ(matrix.components, numbers.components);
        EXPECT_EQ(matrix.steps, numbers.steps);
    }
    const auto* const cpca = asset.moving().transfer.as<CpcaTransfer>();
    ASSERT_NE(cpca, nullptr);
    const VertexClusters& clusters = expected.moving().transfer.as<CpcaTransfer>()->clusters;
    EXPECT_EQ(cpca->clusters.cluster, clusters.cluster);
    EXPECT_EQ(cpca->clusters.coefficients, clusters.coefficients);
    ASSERT_NE(asset.still(), nullptr);
    EXPECT_EQ(asset.still()->positions, expected.still()->positions);
    EXPECT_EQ(asset.still()->transfer->matrix, expected.still()->transfer->matrix);
}

TEST(Golden, ReadsVersionOne) {
    const Asset asset = read_paim(std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1.paim");
    const Asset expected = golden_asset();
    EXPECT_EQ(asset.moving().topology, expected.moving().topology);
    EXPECT_EQ(asset.moving().positions.components, expected.moving().positions.components);
    DecodedPose pose;
    MeshDecoder(asset.moving()).decode(1.0, {}, pose);
    // Row 0 of pose 1, mean + Σ weight · component, worked out once by another program.
    EXPECT_FLOAT_EQ(pose.positions[0], 0.170600212f);
}

}  // namespace
}  // namespace paim
