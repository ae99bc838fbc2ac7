// Components that vanish among others that do not: what is left keeps its own singular values.
#include <gtest/gtest.h>

#include "compressor/encode/quantise/quantise.h"
#include "paim/base/error.h"
#include "paim/format/container/metadata.h"
#include "paim/format/paim/paim_metadata.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/metrics/singular_value_error.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/quantise/random_factors.h"

namespace paim {
namespace {

// The second and third of four components are below half a step.
LowRank quantised() {
    ScaledFactors factors = random_factors({400, 4, 12, {1.0, 0.05, 0.05, 0.5}});
    factors.singular_values = {8.0, 4.0, 2.0, 1.0, 0.5};
    return quantise(factors, {0.1, 1000, std::vector<double>(4, 1.0)});
}

// A file whose transfer is that, of one band and grey.
Asset example_of(LowRank transfer) {
    Asset asset = make_example_asset();
    CodedMesh& mesh = asset.moving();
    mesh.layout = {TransferKind::diffuse, 2, 1};
    mesh.topology = {400, {}};
    mesh.positions = LowRank::still(3, std::vector<float>(1200, 0.0f));
    mesh.positions.num_poses = 12;
    mesh.transfer = SvdTransfer(std::move(transfer));
    return asset;
}

TEST(VanishedComponent, OthersKeepTheirSingularValues) {
    const LowRank matrix = quantised();
    ASSERT_EQ(matrix.num_components, 2u);
    EXPECT_EQ(matrix.singular_values.size(), 5u);
    EXPECT_EQ(matrix.singular_indices, (std::vector<uint32_t>{0, 3}));
    EXPECT_DOUBLE_EQ(theory_error(matrix), 6.5 / 15.5);
    EXPECT_DOUBLE_EQ(energy_error(matrix), std::sqrt(20.25 / 85.25));
}

TEST(VanishedComponent, FirstOnesNeedNoIndices) {
    ScaledFactors factors = random_factors({400, 4, 12, {1.0, 0.5, 0.05}});
    const LowRank some = quantise(factors, {0.1, 1000, std::vector<double>(4, 1.0)});
    EXPECT_EQ(some.num_components, 2u);
    EXPECT_TRUE(some.singular_indices.empty());
    EXPECT_DOUBLE_EQ(theory_error(some), theory_error(some.singular_values, 2));
    EXPECT_DOUBLE_EQ(energy_error(some), energy_error(some.singular_values, 2));
    const LowRank none = quantise(factors, {10.0, 1000, std::vector<double>(4, 1.0)});
    EXPECT_TRUE(none.singular_indices.empty());
    EXPECT_DOUBLE_EQ(theory_error(none), 1.0);
}

// Had the last one the second value, it would come before the geometry's.
TEST(VanishedComponent, OthersAreWhereTheirEnergyPutsThem) {
    Asset asset = example_of(quantised());
    asset.moving().positions.num_components = 1;
    asset.moving().positions.singular_values = {3.0, 3.0};
    asset.moving().transfer->matrix.singular_values = {8.0, 7.9, 7.9, 1.0};
    const std::vector<ComponentId> expected{
        {Attribute::geometry, 0}, {Attribute::transfer, 0}, {Attribute::transfer, 1}};
    // Shares 0.5, 0.34 and 0.005. The second value would have 0.33.
    EXPECT_EQ(component_order(asset), expected);
    asset.moving().positions.singular_values = {1.0, 2.0, 2.0};  // 0.11
    EXPECT_EQ(component_order(asset)[1], (ComponentId{Attribute::geometry, 0}));
}

TEST(VanishedComponent, FilesSayWhichAreLeft) {
    const TemporaryDirectory directory;
    const Asset asset = example_of(quantised());
    write_paim(directory / "x.paim", asset);
    const Asset read = read_paim(directory / "x.paim");
    const LowRank& matrix = read.moving().transfer->matrix;
    EXPECT_EQ(matrix.singular_indices, asset.moving().transfer->matrix.singular_indices);
    EXPECT_TRUE(read.moving().positions.singular_indices.empty());
    EXPECT_NEAR(theory_error(matrix), 6.5 / 15.5, 1e-7);  // of floats
    const std::string metadata = paim_metadata(asset);
    EXPECT_NE(metadata.find("transfer_singular_indices"), std::string::npos);
    EXPECT_EQ(metadata.find("geometry_singular_indices"), std::string::npos);
}

TEST(VanishedComponent, IndicesThatMakeNoSenseAreRefused) {
    const auto read = [](const std::string& indices, size_t num_values) {
        const Metadata metadata("{\"transfer_singular_indices\":" + indices + "}", "x.paim");
        return read_singular_indices(metadata, Attribute::transfer, 2, num_values);
    };
    EXPECT_EQ(read("[0,3]", 4), (std::vector<uint32_t>{0, 3}));
    for (const char* bad : {"[0,4]", "[3,0]", "[1,1]", "[-1,2]", "[0,1.5]", "[0]", "[0,1,2]",
                            "[0,\"1\"]", "3", "[0,null]"}) {
        try {
            read(bad, 4);
            ADD_FAILURE() << bad;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input) << bad;
            EXPECT_NE(std::string(error.what()).find("x.paim"), std::string::npos);
        }
    }
    EXPECT_THROW(read("[0,1]", 0), Error);
    const Metadata silent("{}", "x.paim");
    EXPECT_TRUE(read_singular_indices(silent, Attribute::transfer, 2, 4).empty());
}

}  // namespace
}  // namespace paim
