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
#include "tests/example_model.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

const std::filesystem::path kNewest = std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1.paim";

Asset golden_model() {
    Asset model = make_example_model(2, 1, 3, 2);
    model.moving().transfer->matrix.precision = Precision::f16;
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

Asset golden_model_with_scenery() {
    Asset model = golden_model();
    model.scenery = make_example_scenery(model.moving().layout);
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
    EXPECT_EQ(scenery.topology, expected.moving().topology);
    EXPECT_EQ(scenery.albedo.values, expected.moving().albedo.values);
    EXPECT_EQ(scenery.positions, expected.positions);
    EXPECT_EQ(scenery.transfer, expected.moving().transfer->matrix);
}

// Integers of every kind. Read, not written: bytes depend on the version of Zstandard.
Asset golden_model_of_integers() {
    Asset model = make_clustered_example(3, 3, 2, true);
    model.vertex_order = VertexOrder::cache;
    model.scenery = make_quantised_scenery(model.moving().layout);
    return model;
}

TEST(Golden, ReadsIntegers) {
    const std::filesystem::path file =
        std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1_integers.paim";
    if (std::getenv("PAIM_UPDATE_GOLDEN") != nullptr) write_paim(file, golden_model_of_integers());
    const Asset model = read_paim(file), expected = golden_model_of_integers();
    for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
        EXPECT_EQ(model.moving().attribute(attribute).mean, expected.moving().attribute(attribute).mean);
        EXPECT_EQ(model.moving().attribute(attribute).components, expected.moving().attribute(attribute).components);
        EXPECT_EQ(model.moving().attribute(attribute).steps, expected.moving().attribute(attribute).steps);
    }
    EXPECT_EQ(model.clusters.cluster, expected.clusters.cluster);
    EXPECT_EQ(model.clusters.coefficients, expected.clusters.coefficients);
    EXPECT_EQ(model.scenery.positions, expected.scenery.positions);
    EXPECT_EQ(model.scenery.transfer, expected.scenery.transfer);
}

TEST(Golden, ReadsVersionOne) {
    const Asset model = read_paim(std::filesystem::path(PAIM_GOLDEN_DIR) / "example_v1.paim");
    const Asset expected = golden_model();
    EXPECT_EQ(model.moving().topology, expected.moving().topology);
    EXPECT_EQ(model.moving().positions.components, expected.moving().positions.components);
    DecodedPose pose;
    SvdDecoder(model).decode(1.0, {}, pose);
    // Row 0 of pose 1, mean + Σ weight · component, worked out once by another program.
    EXPECT_FLOAT_EQ(pose.positions[0], 0.170600212f);
}

}  // namespace
}  // namespace paim
