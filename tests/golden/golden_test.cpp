// The bytes of the file format, version by version. A version's files stay readable for ever, and
// what is written today is exactly the newest golden file.
//
// PAIM_UPDATE_GOLDEN=1 writes the newest file again; a change of format adds a file and leaves the
// old ones alone.
#include <gtest/gtest.h>

#include <cstdlib>

#include "paim/base/file.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "paim/format/pack/zstd_decoder.h"
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

// Still parts came later, as sections that earlier readers pass over.
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

// Integers of every kind. Bytes depend on the versions of Zstandard and meshoptimizer: what is in
// their frames does not.
const std::filesystem::path kIntegers =
    std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1_integers.paim";

Asset golden_asset_of_integers() {
    Asset asset = make_clustered_example(3, 3, 2, true);
    asset.vertex_order = VertexOrder::cache;
    return with_still(asset, make_quantised_still(asset.moving().layout));
}

TEST(Golden, ReadsIntegers) {
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) {
        write_paim(kIntegers, golden_asset_of_integers());
    }
    const Asset asset = read_paim(kIntegers), expected = golden_asset_of_integers();
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

// What a section's bytes are before Zstandard.
std::vector<uint8_t> contents_of(const ContainerReader& reader, const Section& section) {
    const std::vector<uint8_t> stored = reader.read_stored(section);
    if (section.codec == SectionCodec::none) return stored;
    std::vector<uint8_t> contents(zstd_content_size(stored).value());
    EXPECT_TRUE(zstd_decompress(stored, contents));
    return contents;
}

TEST(Golden, WritesIntegersByteForByteButForTheirFrames) {
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", golden_asset_of_integers());
    const ContainerReader written(directory / "x.paim", section::kKindAnimation);
    const ContainerReader golden(kIntegers, section::kKindAnimation);
    ASSERT_EQ(written.sections().size(), golden.sections().size());
    size_t num_planes = 0;
    for (size_t j = 0; j < golden.sections().size(); ++j) {
        const Section& section = golden.sections()[j];
        const Section& ours = written.sections()[j];
        const std::string name = golden.label(section);
        ASSERT_EQ(ours.spec, section.spec) << name;
        ASSERT_EQ(ours.codec, section.codec) << name;
        num_planes += section.codec == SectionCodec::planes;
        if (section.codec == SectionCodec::indices) continue;  // meshoptimizer's
        EXPECT_EQ(contents_of(written, ours), contents_of(golden, section)) << name;
    }
    // Two means and three components each, two coefficients of vertices and their clusters, a still
    // mesh.
    EXPECT_GE(num_planes, 10u);
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
