// Errors of the first components, against decoding with and without the others.
#include "paim/metrics/prefix_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/codec/component_planes.h"
#include "tests/example_asset.h"
#include "tests/first_components.h"

namespace paim {
namespace {

double decoded_energy(const CodedMesh& mesh, const CodedMesh& other, Attribute attribute,
                      const std::vector<double>& plane_weight) {
    double energy = 0.0;
    for (uint32_t plane = 0; plane < plane_weight.size(); ++plane) {
        const Eigen::MatrixXd difference = decode_plane(mesh, attribute, plane).cast<double>() -
                                           decode_plane(other, attribute, plane).cast<double>();
        energy += plane_weight[plane] * difference.squaredNorm();
    }
    return energy;
}

CodedMesh without_values(CodedMesh mesh, Attribute attribute) {
    LowRank& matrix = attribute == Attribute::geometry ? mesh.positions : mesh.transfer->matrix;
    matrix.keep_components(0);
    matrix.mean = std::vector<float>(matrix.num_rows());
    return mesh;
}

// Components of the examples are random, so that they are far from orthogonal.
TEST(PrefixError, IsWhatDecodingLacks) {
    for (const Asset& asset :
         {make_example_asset(3, 1), quantise_example(make_example_asset(2, 3)),
          make_clustered_example(2, 3, 2, true), make_clustered_example(3, 1, 1)}) {
        for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
            const CodedMesh& mesh = asset.moving();
            const LowRank& matrix = mesh.attribute(attribute);
            std::vector<double> plane_weight;
            for (uint32_t j = 0; j < matrix.num_planes; ++j) plane_weight.push_back(1.0 / (1 + j));
            const ComponentEnergy energy = component_energy(mesh, attribute, plane_weight);
            const double decoded =
                decoded_energy(mesh, without_values(mesh, attribute), attribute, plane_weight);
            // Decoding adds up in floats: a few roundings of 6e-8, times two as these are squares.
            EXPECT_NEAR(energy.decoded, decoded, 1e-6 * decoded);
            ASSERT_EQ(energy.dropped.size(), size_t{matrix.num_components} + 1);
            EXPECT_EQ(energy.dropped.back(), 0.0);
            for (uint32_t k = 0; k < matrix.num_components; ++k) {
                const Asset coarser = first_components(asset, k, k);
                const double lacking =
                    decoded_energy(mesh, coarser.moving(), attribute, plane_weight);
                EXPECT_GT(lacking, 0.0);
                EXPECT_NEAR(energy.dropped[k], lacking, 1e-6 * decoded) << k;
            }
        }
    }
}

// One vertex, one plane or three, numbers that can be followed by hand.
CodedMesh hand_made() {
    CodedMesh mesh = make_example_asset(1, 1, 2, 1).moving();
    const auto fill = [](LowRank& matrix, float mean, float component) {
        matrix.mean = std::vector<float>(matrix.num_rows(), mean);
        matrix.components = {StoredValues(std::vector<float>(matrix.num_rows(), component))};
        matrix.weights = {1.0f, -1.0f};
    };
    fill(mesh.positions, 5.0f, 2.0f);
    fill(mesh.transfer->matrix, 4.0f, 3.0f);
    return mesh;
}

TEST(PrefixError, WithoutAStatementIsWhatTheMissingComponentsCost) {
    const PrefixErrors errors = prefix_errors(hand_made(), {});
    EXPECT_FALSE(errors.transfer_stated);
    EXPECT_FALSE(errors.position_stated);
    EXPECT_EQ(errors.band_power, "flat");
    // A transfer of 7 and 1 in turns, of which 3 and −3 are missing: √(9 / 25). Every position is
    // off by (2, 2, 2).
    ASSERT_EQ(errors.transfer.size(), 2u);
    EXPECT_DOUBLE_EQ(errors.transfer[0], 0.6);
    EXPECT_EQ(errors.transfer[1], 0.0);
    ASSERT_EQ(errors.position_rms.size(), 2u);
    EXPECT_DOUBLE_EQ(errors.position_rms[0], std::sqrt(12.0));
    EXPECT_EQ(errors.position_rms[1], 0.0);
}

// The mean over positions is one over those that a face has.
TEST(PrefixError, DoesNotCountVerticesOfNoFace) {
    CodedMesh mesh = hand_made();
    mesh.topology.triangles = {{0, 1, 2}};
    std::vector<float> component(12, 2.0f);
    for (const size_t row : {3, 7, 11}) component[row] = 0.0f;  // of vertex 3
    mesh.positions.components = {StoredValues(component)};
    EXPECT_DOUBLE_EQ(prefix_errors(mesh, {}).position_rms[0], std::sqrt(12.0));
}

TEST(PrefixError, AddsWhatTheFileStatesInSquares) {
    ErrorStatement statement{
        "natural",
        {{"transfer_total_error", 0.3}, {"transfer_deviation", 0.8}, {"position_rms", 2}}};
    PrefixErrors errors = prefix_errors(hand_made(), statement);
    EXPECT_TRUE(errors.transfer_stated);
    EXPECT_TRUE(errors.position_stated);
    EXPECT_EQ(errors.band_power, "natural");
    // The bake's transfer has an energy of 25 a pose decoded and (0.8 / 0.6)² times that not.
    EXPECT_DOUBLE_EQ(errors.transfer[0], std::sqrt(0.09 + 0.36 * 0.36));
    EXPECT_DOUBLE_EQ(errors.transfer[1], 0.3);
    EXPECT_DOUBLE_EQ(errors.position_rms[0], 4.0);
    EXPECT_DOUBLE_EQ(errors.position_rms[1], 2.0);

    // Under a map that is not at hand.
    statement.band_power = "sky.exr";
    errors = prefix_errors(hand_made(), statement);
    EXPECT_FALSE(errors.transfer_stated);
    EXPECT_TRUE(errors.position_stated);
    EXPECT_EQ(errors.band_power, "flat");
    EXPECT_DOUBLE_EQ(errors.transfer[0], 0.6);
    EXPECT_DOUBLE_EQ(errors.position_rms[1], 2.0);
}

// Bands count as much as there is light in them.
TEST(PrefixError, WeighsBandsByTheLight) {
    CodedMesh mesh = make_example_asset(2, 1, 2, 1).moving();
    LowRank& transfer = mesh.transfer->matrix;
    const std::vector<float> mean{1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    const std::vector<float> component{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0};
    transfer.mean = mean;
    transfer.components = {StoredValues(component)};
    transfer.weights = {1.0f, -1.0f};
    EXPECT_DOUBLE_EQ(prefix_errors(mesh, {}).transfer[0], std::sqrt(1.0 / 2.0));
    // (l + 1)⁻² is a quarter in band 1.
    const ErrorStatement statement{"natural", {{"transfer_total_error", 0.0}}};
    EXPECT_DOUBLE_EQ(prefix_errors(mesh, statement).transfer[0], std::sqrt(0.25 / 1.25));
}

// An animation of which nothing is lit has no error that is not a number.
TEST(PrefixError, OfZerosIsZero) {
    CodedMesh mesh = make_example_asset(2, 1, 3, 1).moving();
    mesh.transfer->matrix.mean = std::vector<float>(16);
    mesh.transfer->matrix.components = {StoredValues(std::vector<float>(16))};
    EXPECT_EQ(prefix_errors(mesh, {}).transfer, (std::vector<double>{0.0, 0.0}));
}

}  // namespace
}  // namespace paim
