// What files state, and what limits add to it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "paim/metrics/prefix_error.h"
#include "player/inspect/accuracy.h"
#include "player/inspect/cost.h"
#include "tests/player/inspect_asset.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr const char* kStatement = R"({"bake_bands": 7, "measured": {"light_spectrum": "natural",
    "transfer_total_error": 0.3, "transfer_deviation": 0.1, "position_relative_rms": 0.02}})";

std::vector<Asset> stated_assets(const std::string& provenance) {
    TestAssetOptions options;
    std::vector<Asset> assets{make_test_asset(options)};
    options.num_clusters = 3;
    options.cluster_components = 2;
    assets.push_back(make_test_asset(options));
    for (Asset& asset : assets) asset.provenance_json = provenance;
    return assets;
}

// paim-info --prefixes has the same numbers, without limits of bands.
TEST(Accuracy, OfFewerComponentsIsThatOfPrefixes) {
    for (const Asset& asset : stated_assets(kStatement)) {
        const AccuracyMeter meter(shared(asset));
        ASSERT_TRUE(meter.stated());
        EXPECT_EQ(meter.band_power(), "natural");
        EXPECT_EQ(meter.note(), "");
        const PrefixErrors prefixes = prefix_errors(asset.moving(), meter.stated());
        for (uint32_t k = 0; k < prefixes.transfer.size(); ++k) {
            const Accuracy accuracy = meter.at({.transfer_components = k});
            ASSERT_TRUE(accuracy.transfer_total);
            EXPECT_NEAR(*accuracy.transfer_total, prefixes.transfer[k], 1e-12);
            EXPECT_EQ(accuracy.bands_dropped, 0.0);
            EXPECT_EQ(accuracy.transfer.used, k);
        }
        const Accuracy whole = meter.at({});
        EXPECT_EQ(whole.transfer_dropped, 0.0);
        EXPECT_EQ(whole.position_dropped, 0.0);
        EXPECT_DOUBLE_EQ(*whole.transfer_total, 0.3);
        EXPECT_DOUBLE_EQ(*whole.position_total, 0.02);
        EXPECT_EQ(whole.bands_in_bake, 7u);
        EXPECT_EQ(whole.bands_in_file, 5u);
    }
}

// Energies of four vertices and two poses: 8 · 9 in band 0, of which the component has 4 · (1 + ¼) at
// vertex 3 alone, and 8 · 16 in band 1.
TEST(Accuracy, AddsComponentsAndBandsInSquares) {
    Asset asset = square_asset(2, 1, {3, 3, 3, 3, 4, 4, 4, 4, 0, 0, 0, 0, 0, 0, 0, 0},
                               {0, 0, 0, 0, 0, 0, 0, 0, 2, 2, 2, 2, 0, 0, 0, 0});
    asset.moving().transfer->matrix.weights = {1.0f, -1.0f};
    const AccuracyMeter meter(shared(asset));
    const double norm = 8.0 * (9.0 + 16.0 + 4.0);
    Accuracy accuracy = meter.at({.transfer_components = 0});
    EXPECT_NEAR(accuracy.transfer_dropped, std::sqrt(8.0 * 4.0 / norm), 1e-12);
    EXPECT_EQ(accuracy.bands_dropped, 0.0);
    // Without band 1 nothing is left that the component could change.
    for (const uint32_t components : {0u, 1u}) {
        accuracy = meter.at({.transfer_components = components, .bands = 1});
        EXPECT_NEAR(accuracy.transfer_dropped, std::sqrt(8.0 * 20.0 / norm), 1e-12);
        EXPECT_NEAR(accuracy.bands_dropped, accuracy.transfer_dropped, 1e-12);
        EXPECT_EQ(accuracy.bands, 1u);
    }
    EXPECT_FALSE(accuracy.transfer_total);
    EXPECT_FALSE(accuracy.position_total);
}

TEST(Accuracy, TheoreticalErrorIsTheDroppedShareOfSingularValues) {
    Asset asset = square_asset(1, 1, {1, 1, 1, 1}, {0, 0, 0, 1});  // singular values 3 and 1
    const Accuracy one = AccuracyMeter(shared(asset)).at({});
    EXPECT_DOUBLE_EQ(*one.transfer.theory_error, 0.25);
    EXPECT_DOUBLE_EQ(*one.transfer.energy_error, 1.0 / std::sqrt(10.0));
    EXPECT_EQ(one.transfer.in_file, 1u);
    const Accuracy none = AccuracyMeter(shared(asset)).at({.geometry_components = 0});
    EXPECT_DOUBLE_EQ(*none.geometry.theory_error, 1.0);
    EXPECT_EQ(none.geometry.used, 0u);
    // The component is that of the second singular value.
    asset.moving().transfer->matrix.singular_indices = {1};
    EXPECT_DOUBLE_EQ(*AccuracyMeter(shared(asset)).at({}).transfer.theory_error, 0.75);
    asset.moving().transfer->matrix.singular_indices = {2};  // beyond the last
    EXPECT_FALSE(AccuracyMeter(shared(asset)).at({}).transfer.theory_error);
    asset.moving().transfer->matrix.singular_indices.clear();
    asset.moving().transfer->matrix.singular_values.clear();
    EXPECT_FALSE(AccuracyMeter(shared(asset)).at({}).transfer.theory_error);
    EXPECT_TRUE(AccuracyMeter(shared(asset)).at({}).geometry.theory_error);
}

// Vertex 3 is off by 0.5 and 0.25. The diagonal is that of pose 0.
TEST(Accuracy, OfPositionsIsAFractionInAnyUnit) {
    for (const int exponent : {0, 20}) {
        Asset asset = square_asset(1, 1, {1, 1, 1, 1}, {0, 0, 0, 1});
        asset.provenance_json = kStatement;
        scale_asset(asset, exponent);
        const AccuracyMeter meter(shared(asset));
        const Accuracy accuracy = meter.at({.geometry_components = 0});
        const double expected = std::sqrt((0.25 + 0.0625) / 8.0 / 25.25);
        EXPECT_NEAR(accuracy.position_dropped, expected, 1e-8);
        EXPECT_NEAR(*accuracy.position_total, std::hypot(0.02, expected), 1e-8);
        EXPECT_DOUBLE_EQ(*accuracy.transfer_total, 0.3);
    }
}

// The second component is an exception: vertex 3 is far away in pose 1.
TEST(Accuracy, OfPositionsIsWithoutOutliers) {
    Asset asset = square_asset(1, 1, {1, 1, 1, 1}, {0, 0, 0, 1});
    LowRank& positions = asset.moving().positions;
    positions.num_components = 2;
    positions.components.emplace_back(std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 900});
    positions.weights = {1.0f, 0.5f, 0.0f, 1.0f};
    positions.singular_values = {3.0, 0.0};
    EXPECT_NEAR(AccuracyMeter(shared(asset)).at({.geometry_components = 0}).position_dropped,
                std::sqrt((0.25 + 0.0625) / 8.0 / 25.25), 1e-8);
    EXPECT_EQ(AccuracyMeter(shared(asset)).at({.geometry_components = 1}).position_dropped, 0.0);
}

TEST(Accuracy, OfAPointIsNoError) {
    Asset asset = square_asset(1, 1, {0, 0, 0, 0}, {0, 0, 0, 0});
    asset.moving().positions = four_points(std::vector<float>(12), std::vector<float>(12));
    const Accuracy accuracy = AccuracyMeter(shared(asset)).at({0, 0, 1});
    EXPECT_EQ(accuracy.position_dropped, 0.0);
    EXPECT_EQ(accuracy.transfer_dropped, 0.0);
}

TEST(Accuracy, SaysWhyThereIsNoTotal) {
    for (const Asset& asset : stated_assets("{}")) {
        const AccuracyMeter meter(shared(asset));
        EXPECT_FALSE(meter.stated());
        EXPECT_NE(meter.note().find("states its errors"), std::string::npos);
        EXPECT_FALSE(meter.at({}).transfer_total);
        EXPECT_FALSE(meter.at({}).bands_in_bake);
        EXPECT_GT(meter.at({.transfer_components = 1}).transfer_dropped, 0.0);
    }
    // Damaged statements are none.
    for (const char* text : {"{", R"({"measured": 3})", R"({"bake_bands": -1})",
                             R"({"measured": {"light_spectrum": "flat", "kg_error": -1}})"}) {
        const AccuracyMeter meter(shared(stated_assets(text)[0]));
        EXPECT_FALSE(meter.stated()) << text;
        EXPECT_NE(meter.note(), "") << text;
        EXPECT_FALSE(meter.at({}).transfer_total) << text;
    }
    // Errors under a map say nothing about those of any other light.
    const std::string map = R"({"measured": {"light_spectrum": "sky.exr",
        "transfer_total_error": 0.3, "position_relative_rms": 0.02}})";
    const AccuracyMeter under_map(shared(stated_assets(map)[0]));
    EXPECT_TRUE(under_map.stated());
    EXPECT_EQ(under_map.band_power(), "flat");
    EXPECT_FALSE(under_map.at({}).transfer_total);
    EXPECT_TRUE(under_map.at({}).position_total);
    // Of a file that is still being read, and of fewer components of vertices.
    Asset grouped = stated_assets(kStatement)[1];
    EXPECT_FALSE(AccuracyMeter(shared(grouped)).at({.vertex_components = 1}).transfer_total);
    EXPECT_TRUE(AccuracyMeter(shared(grouped)).at({.vertex_components = 2}).transfer_total);
    grouped.complete = false;
    EXPECT_FALSE(AccuracyMeter(shared(grouped)).at({}).transfer_total);
    EXPECT_FALSE(AccuracyMeter(shared(grouped)).at({}).position_total);
}

TEST(Accuracy, HasTheCostOfTheLimits) {
    for (const Asset& asset : stated_assets("{}")) {
        const DecodeLimits limits{2, 3, 4, 1};
        const Cost cost = AccuracyMeter(shared(asset)).at(limits).cost;
        const Cost expected = frame_cost(asset.moving(), limits);
        EXPECT_EQ(cost.bytes, expected.bytes);
        EXPECT_EQ(cost.multiply_adds, expected.multiply_adds);
        EXPECT_LT(cost.bytes, AccuracyMeter(shared(asset)).at({}).cost.bytes);
    }
}

}  // namespace
}  // namespace paim::player
