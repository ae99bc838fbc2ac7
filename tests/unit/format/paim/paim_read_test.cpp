// .paim files: round trip, order of components, parts that stand still.
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

void expect_equal(const LowRank& a, const LowRank& b) {
    EXPECT_EQ(a.num_planes, b.num_planes);
    EXPECT_EQ(a.num_components, b.num_components);
    EXPECT_EQ(a.precision, b.precision);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.weights, b.weights);
    EXPECT_EQ(a.singular_values, b.singular_values);
}

void expect_equal_still(const Asset& a, const Asset& b) {
    ASSERT_NE(a.still(), nullptr);
    EXPECT_EQ(a.still()->topology.num_vertices, b.still()->topology.num_vertices);
    EXPECT_EQ(a.still()->albedo.values, b.still()->albedo.values);
    EXPECT_EQ(a.still()->layout, b.still()->layout);
    EXPECT_EQ(a.still()->positions, b.still()->positions);
    EXPECT_EQ(a.still()->transfer->matrix, b.still()->transfer->matrix);
}

TEST(PaimFile, RoundTrips) {
    const TemporaryDirectory directory;
    for (const uint32_t channels : {1u, 3u}) {
        Asset asset = make_example_asset(3, channels);
        if (channels == 3) asset.moving().albedo.values.assign(4, Vec3f(0.1f, 0.2f, 0.3f));
        write_paim(directory / "x.paim", asset);
        const Asset read = read_paim(directory / "x.paim");
        EXPECT_EQ(read.moving().topology, asset.moving().topology);
        EXPECT_EQ(read.moving().albedo.values, asset.moving().albedo.values);
        EXPECT_EQ(read.moving().layout, asset.moving().layout);
        EXPECT_EQ(read.name, asset.name);
        EXPECT_EQ(read.provenance_json, asset.provenance_json);
        EXPECT_EQ(read.frames_per_second, asset.frames_per_second);
        expect_equal(read.moving().positions, asset.moving().positions);
        expect_equal(read.moving().transfer->matrix, asset.moving().transfer->matrix);
        EXPECT_EQ(std::filesystem::file_size(directory / "x.paim"), paim_size_bytes(asset));
    }
}

TEST(PaimFile, RoundTripsIntegersAndClusters) {
    const TemporaryDirectory directory;
    for (const bool clustered : {false, true}) {
        Asset asset = make_packed_example(clustered);
        const TransferLayout layout = asset.moving().layout;
        asset.parts.push_back(clustered ? make_quantised_still(layout)
                                        : make_example_still(layout));
        write_paim(directory / "x.paim", asset);
        const Asset read = read_paim(directory / "x.paim");
        EXPECT_EQ(std::filesystem::file_size(directory / "x.paim"), paim_size_bytes(asset));
        // Triangles may be turned.
        ASSERT_EQ(read.moving().topology.triangles.size(),
                  asset.moving().topology.triangles.size());
        for (size_t t = 0; t < read.moving().topology.triangles.size(); ++t) {
            Triangle turned = read.moving().topology.triangles[t];
            const auto first =
                std::find(turned.begin(), turned.end(), asset.moving().topology.triangles[t][0]);
            std::rotate(turned.begin(), first, turned.end());
            EXPECT_EQ(turned, asset.moving().topology.triangles[t]);
        }
        for (const Attribute attribute : {Attribute::geometry, Attribute::transfer}) {
            const LowRank& a = read.moving().attribute(attribute);
            const LowRank& b = asset.moving().attribute(attribute);
            EXPECT_EQ(a.precision, Precision::i16);
            EXPECT_EQ(a.num_points, b.num_points);
            EXPECT_EQ(a.steps, b.steps);
            EXPECT_EQ(a.mean, b.mean);
            EXPECT_EQ(a.components, b.components);
            EXPECT_EQ(a.weights, b.weights);
            EXPECT_EQ(a.weight_steps, b.weight_steps);
            for (size_t k = 0; k < b.singular_values.size(); ++k) {
                EXPECT_FLOAT_EQ(static_cast<float>(a.singular_values[k]),
                                static_cast<float>(b.singular_values[k]));
            }
        }
        const auto* const cpca = read.moving().transfer.as<CpcaTransfer>();
        ASSERT_EQ(cpca != nullptr, clustered);
        if (clustered) {
            const VertexClusters& clusters = asset.moving().transfer.as<CpcaTransfer>()->clusters;
            EXPECT_EQ(cpca->clusters.num_clusters, clusters.num_clusters);
            EXPECT_EQ(cpca->clusters.num_components, clusters.num_components);
            EXPECT_EQ(cpca->clusters.cluster, clusters.cluster);
            EXPECT_EQ(cpca->clusters.coefficients, clusters.coefficients);
            EXPECT_EQ(cpca->clusters.scales, clusters.scales);
        }
        EXPECT_EQ(read.vertex_order, VertexOrder::cache);
        expect_equal_still(read, asset);
        EXPECT_EQ(read.still()->topology.triangles.size(), 2u);
    }
}

// A file with a still part is packed; values of that part are integers times a step for each plane.
TEST(PaimFile, KeepsStillPartsOfIntegers) {
    const TemporaryDirectory directory;
    Asset asset = make_example_asset(3, 3);
    asset.parts.push_back(make_quantised_still(asset.moving().layout));
    write_paim(directory / "x.paim", asset);
    const Asset read = read_paim(directory / "x.paim");
    expect_equal_still(read, asset);
    const LowRank& transfer = read.still()->transfer->matrix;
    EXPECT_TRUE(transfer.mean.holds_i8());
    const std::vector<float> floats = transfer.mean_floats();
    ASSERT_EQ(floats.size(), size_t{4} * asset.moving().layout.num_planes());
    // Value 2 of plane 5: so many steps of 6 hundredths.
    EXPECT_EQ(floats[4 * 5 + 2], (6.0f / 100.0f) * transfer.mean[4 * 5 + 2]);
}

// The file has the integers that smoothing started from, and how often each plane is smoothed.
TEST(PaimFile, SmoothsPositionsAsTheyWere) {
    const TemporaryDirectory directory;
    Asset asset = quantise_example(make_example_asset(3));
    LowRank& positions = asset.moving().positions;
    const LowRank stored = positions;
    positions.fraction_bits = smoothing_fraction_bits(positions);
    ASSERT_GT(positions.fraction_bits, 0u);
    for (uint32_t j = 0; j < 3 * (1 + positions.num_components); ++j) {
        positions.smoothing.push_back(j % (kMaxSmoothingRounds + 1));
    }
    smooth_stored(positions, asset.moving().topology);
    EXPECT_NE(positions.mean, stored.mean);
    write_paim(directory / "x.paim", asset);
    const LowRank read = read_paim(directory / "x.paim").moving().positions;
    expect_equal(read, positions);
    EXPECT_EQ(read.steps, positions.steps);
    EXPECT_EQ(read.smoothing, positions.smoothing);
    EXPECT_EQ(read.fraction_bits, positions.fraction_bits);
    EXPECT_EQ(std::filesystem::file_size(directory / "x.paim"), paim_size_bytes(asset));
}

TEST(PaimFile, KeepsWhatStandsStill) {
    const TemporaryDirectory directory;
    for (const uint32_t channels : {1u, 3u}) {
        Asset asset = make_example_asset(3, channels);
        const uint64_t without = paim_size_bytes(asset);
        asset.parts.push_back(make_example_still(asset.moving().layout));
        write_paim(directory / "x.paim", asset);
        const Asset read = read_paim(directory / "x.paim");
        expect_equal_still(read, asset);
        EXPECT_EQ(read.still()->topology, asset.still()->topology);
        expect_equal(read.moving().transfer->matrix, asset.moving().transfer->matrix);
        EXPECT_EQ(std::filesystem::file_size(directory / "x.paim"), paim_size_bytes(asset));
        EXPECT_GT(paim_size_bytes(asset), without);
    }
}

// The file with all of its sections but one.
void drop_section(const std::filesystem::path& path, Tag tag) {
    const auto bytes = read_file(path, 1 << 20);
    const ContainerReader reader(path, section::kKindAnimation);
    std::vector<Section> kept;
    std::vector<SectionPlan> specs;
    for (const Section& section : reader.sections()) {
        if (section.spec.tag == tag) continue;
        kept.push_back(section);
        specs.push_back(section.spec);
    }
    ContainerWriter writer(path, section::kKindAnimation, specs);
    for (size_t j = 0; j < kept.size(); ++j) {
        writer.append(j, bytes.data() + kept[j].offset, kept[j].stored_size_bytes);
    }
    writer.commit();
}

TEST(PaimFile, WhatStandsStillIsWholeOrAbsent) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    Asset asset = make_example_asset();
    asset.parts.push_back(make_example_still(asset.moving().layout));
    const std::vector<Tag> tags{section::kStillTriangles, section::kStillPositions,
                                section::kStillAlbedo, section::kStillTransfer};
    for (const Tag tag : tags) {
        write_paim(path, asset);
        drop_section(path, tag);
        try {
            read_paim(path);
            ADD_FAILURE() << "read a file without " << tag.str();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find(tag.str()), std::string::npos) << error.what();
        }
    }
    write_paim(path, asset);
    for (const Tag tag : tags) drop_section(path, tag);
    EXPECT_EQ(read_paim(path).parts.size(), 1u);
}

TEST(PaimFile, KeepsTheOriginToTheLastDigit) {
    const TemporaryDirectory directory;
    Asset asset = make_example_asset();
    EXPECT_EQ(asset.origin, Vec3d::Zero());
    const uint64_t size_bytes = paim_size_bytes(asset);
    asset.origin = Vec3d(1.0 / 3.0, -1e30, 0x1.fffffffffffffp-40);
    write_paim(directory / "x.paim", asset);
    EXPECT_EQ(read_paim(directory / "x.paim").origin, asset.origin);
    // Zero is not written, so that ordinary files are what they were before there was an origin.
    asset.origin = Vec3d::Zero();
    write_paim(directory / "x.paim", asset);
    EXPECT_EQ(read_paim(directory / "x.paim").origin, Vec3d::Zero());
    EXPECT_EQ(std::filesystem::file_size(directory / "x.paim"), size_bytes);
}

TEST(PaimFile, HalfComponentsAreRoundedToNearest) {
    const TemporaryDirectory directory;
    Asset asset = make_example_asset();
    asset.moving().transfer->matrix.precision = Precision::f16;
    write_paim(directory / "x.paim", asset);
    const Asset read = read_paim(directory / "x.paim");
    const LowRank& rounded = read.moving().transfer->matrix;
    EXPECT_EQ(rounded.precision, Precision::f16);
    EXPECT_EQ(read.moving().positions.components, asset.moving().positions.components);
    for (size_t j = 0; j < rounded.num_rows(); ++j) {
        const float exact = asset.moving().transfer->matrix.components[1][j];
        // Half floats have 11 significant bits: half a unit in the last place is at most 2^-11 of
        // the value; below 2^-14 they are subnormal, with steps of 2^-24.
        EXPECT_LE(std::abs(rounded.components[1][j] - exact),
                  std::max(std::abs(exact) * 0x1p-11f, 0x1p-25f));
    }
}

TEST(PaimFile, HoldsStillAnimationsWithoutComponents) {
    const TemporaryDirectory directory;
    Asset asset = make_example_asset(2, 1, 5, 0);
    write_paim(directory / "x.paim", asset);
    const Asset read = read_paim(directory / "x.paim");
    EXPECT_EQ(read.num_poses(), 5u);
    EXPECT_TRUE(read.moving().transfer->matrix.components.empty());
}

TEST(PaimFile, OrdersComponentsByShareOfEnergy) {
    Asset asset = make_example_asset();
    asset.moving().positions.singular_values = {10.0, 1.0, 0.1};  // shares 0.99, 0.0099, 0.000099
    asset.moving().transfer->matrix.singular_values = {1.0, 0.5, 0.25};  // shares 0.76, 0.19, 0.048
    const std::vector<ComponentId> expected{{Attribute::geometry, 0}, {Attribute::transfer, 0},
                                            {Attribute::transfer, 1}, {Attribute::transfer, 2},
                                            {Attribute::geometry, 1}, {Attribute::geometry, 2}};
    EXPECT_EQ(component_order(asset), expected);
}

}  // namespace
}  // namespace paim
