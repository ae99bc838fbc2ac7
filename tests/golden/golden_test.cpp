// The bytes of the file format, version by version. A version's files stay readable for ever, and
// what is written today is exactly the newest golden file.
//
// PAIM_UPDATE_GOLDEN=1 writes the newest file anew; a change of format adds one and leaves the old
// alone.
#include <gtest/gtest.h>

#include <cstdlib>

#include "paim/base/file.h"
#include "paim/codec/svd_decoder.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "paim/format/pack/zstd_codec.h"
#include "paim/format/paim/paim_file.h"
#include "tests/example_model.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

const std::filesystem::path kNewest = std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1.paim";

Model golden_model() {
    Model model = make_example_model(2, 1, 3, 2);
    model.transfer.precision = Precision::f16;
    return model;
}

TEST(Golden, WritesTheNewestFileByteForByte) {
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) write_paim(kNewest, golden_model());
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", golden_model());
    EXPECT_EQ(read_file(directory / "x.paim", 1 << 20), read_file(kNewest, 1 << 20));
}

// Scenery came later, as sections that earlier readers pass over.
const std::filesystem::path kScenery =
    std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1_scenery.paim";

Model golden_model_with_scenery() {
    Model model = golden_model();
    model.scenery = make_example_scenery(model.layout);
    return model;
}

TEST(Golden, WritesSceneryByteForByte) {
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) {
        write_paim(kScenery, golden_model_with_scenery());
    }
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", golden_model_with_scenery());
    EXPECT_EQ(read_file(directory / "x.paim", 1 << 20), read_file(kScenery, 1 << 20));
}

TEST(Golden, ReadsScenery) {
    const Scenery scenery = read_paim(kScenery).scenery;
    const Scenery expected = golden_model_with_scenery().scenery;
    EXPECT_EQ(scenery.topology, expected.topology);
    EXPECT_EQ(scenery.albedo.values, expected.albedo.values);
    EXPECT_EQ(scenery.positions, expected.positions);
    EXPECT_EQ(scenery.transfer, expected.transfer);
}

// Integers of every kind. Bytes depend on the versions of Zstandard and meshoptimizer: what is in
// their frames does not.
const std::filesystem::path kIntegers =
    std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1_integers.paim";

Model golden_model_of_integers() {
    Model model = make_clustered_example(3, 3, 2, true);
    model.vertex_order = VertexOrder::cache;
    model.scenery = make_quantised_scenery(model.layout);
    return model;
}

TEST(Golden, ReadsIntegers) {
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) {
        write_paim(kIntegers, golden_model_of_integers());
    }
    const Model model = read_paim(kIntegers), expected = golden_model_of_integers();
    for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
        EXPECT_EQ(model.attribute(attribute).mean, expected.attribute(attribute).mean);
        EXPECT_EQ(model.attribute(attribute).components, expected.attribute(attribute).components);
        EXPECT_EQ(model.attribute(attribute).steps, expected.attribute(attribute).steps);
    }
    EXPECT_EQ(model.clusters.cluster, expected.clusters.cluster);
    EXPECT_EQ(model.clusters.coefficients, expected.clusters.coefficients);
    EXPECT_EQ(model.scenery.positions, expected.scenery.positions);
    EXPECT_EQ(model.scenery.transfer, expected.scenery.transfer);
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
    write_paim(directory / "x.paim", golden_model_of_integers());
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
    // Two means and three components each, two coefficients of vertices and their clusters, scenery.
    EXPECT_GE(num_planes, 10u);
}

TEST(Golden, ReadsVersionOne) {
    const Model model = read_paim(std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1.paim");
    const Model expected = golden_model();
    EXPECT_EQ(model.topology, expected.topology);
    EXPECT_EQ(model.geometry.components, expected.geometry.components);
    DecodedPose pose;
    SvdDecoder(model).decode(1.0, {}, pose);
    // Row 0 of pose 1, mean + Σ weight · component, worked out once by another program.
    EXPECT_FLOAT_EQ(pose.positions[0], 0.170600212f);
}

}  // namespace
}  // namespace paim
