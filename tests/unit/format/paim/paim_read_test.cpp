// .paim files: round trip, order of components, cuts at 50 places, numbers that make no sense.
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/error.h"
#include "paim/base/file.h"
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

// With weights that are integers, too, as the encoder makes them.
Asset packed_example(bool clustered) {
    Asset asset = clustered ? make_clustered_example(3, 3, 2, true)
                            : quantise_example(make_example_asset(3, 3));
    asset.vertex_order = VertexOrder::cache;
    LowRank& matrix = asset.moving().transfer->matrix;
    matrix.weight_steps = {0.25f, 0.0f, 1e-3f};
    for (size_t j = 0; j < matrix.weights.size(); ++j) {
        const float step = matrix.weight_steps[j / matrix.num_poses];
        const auto q = static_cast<int32_t>(j * 977 % 4001) - 2000;
        matrix.weights[j] = step * static_cast<float>(q);
    }
    return asset;
}

TEST(PaimFile, RoundTripsIntegersAndClusters) {
    const TemporaryDirectory directory;
    for (const bool clustered : {false, true}) {
        Asset asset = packed_example(clustered);
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

// Files of integers hold them as floats: larger ones could be written, but not read.
TEST(PaimFile, RefusesSingularValuesThatAreNoFloats) {
    const TemporaryDirectory directory;
    Asset asset = packed_example(false);
    asset.moving().positions.singular_values[0] = 1e39;
    try {
        write_paim(directory / "x.paim", asset);
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find("a singular value is 1e+39"), std::string::npos)
            << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(directory / "x.paim"));
}

// Whatever a compressed file's bytes are, and even where all checksums are right: an asset that can
// be played, or a clear error.
TEST(PaimFile, SurvivesAnyByteOfCompressedSections) {
    const TemporaryDirectory directory;
    for (const bool clustered : {false, true}) {
        write_paim(directory / "x.paim", packed_example(clustered));
        const auto whole = read_file(directory / "x.paim", 1 << 20);
        const ContainerReader reader(directory / "x.paim", section::kKindAnimation);
        int refused = 0, read = 0;
        for (size_t s = 0; s < reader.sections().size(); ++s) {
            const Section& damaged = reader.sections()[s];
            for (uint64_t place = 0; place < damaged.stored_size_bytes; ++place) {
                std::vector<SectionPlan> plans;
                for (const Section& section : reader.sections()) {
                    plans.emplace_back(section.spec, section.codec, section.stored_size_bytes);
                }
                ContainerWriter writer(directory / "y.paim", section::kKindAnimation, plans);
                for (size_t j = 0; j < plans.size(); ++j) {
                    const Section& section = reader.sections()[j];
                    std::vector<char> bytes(
                        whole.begin() + static_cast<ptrdiff_t>(section.offset),
                        whole.begin() +
                            static_cast<ptrdiff_t>(section.offset + section.stored_size_bytes));
                    if (j == s) bytes[place] = static_cast<char>(bytes[place] ^ (1 << (place % 8)));
                    writer.append(j, bytes.data(), bytes.size());
                }
                writer.commit();
                try {
                    const Asset asset = read_paim(directory / "y.paim");
                    const auto* const cpca = asset.moving().transfer.as<CpcaTransfer>();
                    ASSERT_EQ(cpca != nullptr, clustered);
                    if (cpca != nullptr) {
                        for (const uint32_t cluster : cpca->clusters.cluster) {
                            ASSERT_LT(cluster, cpca->clusters.num_clusters);
                        }
                    }
                    ++read;
                } catch (const Error& error) {
                    EXPECT_TRUE(error.code() == ExitCode::bad_input ||
                                error.code() == ExitCode::unsupported)
                        << error.what();
                    EXPECT_NE(std::string(error.what()).find("y.paim"), std::string::npos);
                    ++refused;
                }
            }
        }
        EXPECT_GT(refused, 300);  // frames and shapes
        EXPECT_GT(read, 30);      // numbers that are merely others
    }
}

TEST(PaimFile, TakesNoMemoryForVerticesThatNothingIsClaimedOf) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    Asset asset = packed_example(false);
    write_paim(path, asset);
    // Without the mean of the geometry, and two thousand million vertices.
    const auto bytes = read_file(path, 1 << 20);
    const ContainerReader reader(path, section::kKindAnimation);
    std::string metadata = reader.read_text(reader.require(section::kMetadata, ScalarType::u8));
    const std::string count = "\"num_vertices\": 4";
    metadata.replace(metadata.find(count), count.size(), "\"num_vertices\": 2147483647");
    std::vector<SectionPlan> plans{SectionSpec{
        section::kMetadata, ScalarType::u8, 0, {1, 1, static_cast<uint32_t>(metadata.size())}}};
    std::vector<std::string> contents{metadata};
    for (const Section& section : reader.sections()) {
        if (section.spec.tag == section::kMetadata || section.spec.tag == section::kMean[0])
            continue;
        plans.emplace_back(section.spec, section.codec, section.stored_size_bytes);
        contents.emplace_back(bytes.data() + section.offset, section.stored_size_bytes);
    }
    ContainerWriter writer(path, section::kKindAnimation, plans);
    for (size_t j = 0; j < plans.size(); ++j) {
        writer.append(j, contents[j].data(), contents[j].size());
    }
    writer.commit();
    try {
        read_paim(path);
        ADD_FAILURE() << "read a file without positions";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("GMEA 0 is missing"), std::string::npos)
            << error.what();
    }
}

TEST(PaimFile, RefusesClaimsOfFarMoreValuesThanBytes) {
    const TemporaryDirectory directory;
    const auto path = directory / "x.paim";
    ContainerWriter writer(path, section::kKindAnimation,
                           {SectionPlan({Tag("TMEA"), ScalarType::i8, 0, {1, 1u << 15, 1u << 15}},
                                        SectionCodec::planes, 3)});
    writer.append(0, "abc", 3);
    writer.commit();
    try {
        const ContainerReader reader(path, section::kKindAnimation);
        ADD_FAILURE() << "opened a file of a gigabyte of claims";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("sections claim more than"), std::string::npos)
            << error.what();
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

// What predicts them takes 40 bytes a vertex, whatever they are packed to.
TEST(PaimFile, RefusesMoreVerticesThanASmallFileMayHave) {
    const TemporaryDirectory directory;
    Asset asset = quantise_example(make_example_asset(1));
    asset.moving().topology = {2'000'000, {}};
    const auto empty = [&](LowRank& matrix) {
        matrix.num_points = asset.moving().topology.num_vertices;
        matrix.num_components = 0;
        matrix.mean = std::vector<int8_t>(matrix.num_rows());
        matrix.components.clear();
        matrix.weights.clear();
    };
    empty(asset.moving().positions);
    empty(asset.moving().transfer->matrix);
    try {
        write_paim(directory / "x.paim", asset);
        ADD_FAILURE() << "written";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_NE(std::string(error.what()).find("2000000 vertices and"), std::string::npos)
            << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(directory / "x.paim"));
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

TEST(PaimFile, RefusesCutsAtFiftyPlaces) {
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", make_example_asset(5));
    const auto whole = read_file(directory / "x.paim", 1 << 20);
    for (size_t cut = 0; cut < 50; ++cut) {
        const size_t length = whole.size() * cut / 50;
        write_file(directory / "cut.paim", {whole.data(), length});
        try {
            read_paim(directory / "cut.paim");
            ADD_FAILURE() << "read a file cut at " << length;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find("cut.paim"), std::string::npos);
        }
    }
}

// What reading this asset's file says.
std::string complaint(const Asset& asset) {
    const TemporaryDirectory directory;
    write_paim(directory / "x.paim", asset);
    try {
        read_paim(directory / "x.paim");
        return "nothing";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
}

TEST(PaimFile, RefusesContentsThatCannotBePlayed) {
    Asset asset = make_example_asset();
    asset.moving().topology.triangles[1][2] = 4;
    EXPECT_NE(complaint(asset).find("triangle 1: vertex 4, expected 0 to 3"), std::string::npos);

    asset = make_example_asset();
    StoredValues& component = asset.moving().transfer->matrix.components[0];
    std::vector<float> values = component.floats();
    values[5] = std::nanf("");
    component = std::move(values);
    EXPECT_NE(complaint(asset).find("section TCMP: value 5 is nan"), std::string::npos)
        << complaint(asset);

    asset = make_example_asset();
    asset.moving().positions.singular_values = {1.0, 2.0, 0.5};
    EXPECT_NE(complaint(asset).find("descending"), std::string::npos);

    asset = make_example_asset();
    asset.moving().albedo.values.resize(3, Vec3f::Zero());
    EXPECT_NE(complaint(asset).find("expected 1 or 4 colours"), std::string::npos);

    asset = make_example_asset();
    asset.provenance_json = std::string(100, '[') + std::string(100, ']');
    asset.provenance_json = "{\"a\": " + asset.provenance_json + "}";
    EXPECT_NE(complaint(asset).find("nested more than 16 deep"), std::string::npos);

    asset = make_example_asset(2, 1, 2, 3);  // three components of two poses
    EXPECT_NE(complaint(asset).find("'geometry_components': expected 0 to 2, got 3"),
              std::string::npos);

    const Asset whole = make_example_asset();
    const TransferLayout layout = whole.moving().layout;
    asset = with_still(whole, make_example_still(layout));
    asset.still()->topology.triangles[1][0] = 4;
    EXPECT_NE(complaint(asset).find("triangle 1: vertex 4, expected 0 to 3"), std::string::npos);
    asset = with_still(whole, make_example_still(layout));
    std::vector<float> positions = asset.still()->positions.mean.floats();
    positions[7] = std::nanf("");
    asset.still()->positions.mean = positions;
    EXPECT_NE(complaint(asset).find("section SPOS: value 7 is nan"), std::string::npos);
    asset = with_still(whole, make_example_still(layout));
    std::vector<float> transfer = asset.still()->transfer->matrix.mean.floats();
    transfer[3] = std::numeric_limits<float>::infinity();
    asset.still()->transfer->matrix.mean = transfer;
    EXPECT_NE(complaint(asset).find("section STRN: value 3 is inf"), std::string::npos);
    asset = with_still(whole, make_quantised_still(layout));
    asset.still()->transfer->matrix.steps[1] = -1.0f;
    EXPECT_NE(complaint(asset).find("steps: expected numbers from 0 to 1.04e+34, got -1"),
              std::string::npos)
        << complaint(asset);
    asset = with_still(whole, make_example_still(layout));
    asset.still()->albedo.values.resize(3);
    EXPECT_NE(complaint(asset).find("expected 1 or 4 colours"), std::string::npos);

    asset = make_example_asset();
    asset.moving().layout.in_bands = 3;  // says 9 planes, holds 4
    EXPECT_NE(complaint(asset).find("expected 9 x 4"), std::string::npos) << complaint(asset);
}

}  // namespace
}  // namespace paim
