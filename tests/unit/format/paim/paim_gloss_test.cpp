// Gloss in .paim files: round trip, prefixes, and what readers refuse.
#include <gtest/gtest.h>

#include <algorithm>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/gloss_frames.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/format/paim/prefixes.h"
#include "tests/gloss_example.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

void expect_equal_gloss(const CodedGloss& a, const CodedGloss& b) {
    EXPECT_EQ(a.layout, b.layout);
    EXPECT_EQ(a.num_rows, b.num_rows);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.tint.values, b.tint.values);
    EXPECT_EQ(a.transfer->codec_name(), b.transfer->codec_name());
    EXPECT_EQ(a.transfer->matrix.mean, b.transfer->matrix.mean);
    EXPECT_EQ(a.transfer->matrix.components, b.transfer->matrix.components);
    EXPECT_EQ(a.transfer->matrix.weights, b.transfer->matrix.weights);
    EXPECT_EQ(a.transfer->matrix.steps, b.transfer->matrix.steps);
    EXPECT_EQ(a.frame_turns, b.frame_turns);
    if (const auto* clusters = a.transfer.as<CpcaTransfer>()) {
        const auto* others = b.transfer.as<CpcaTransfer>();
        ASSERT_NE(others, nullptr);
        EXPECT_EQ(clusters->clusters.cluster, others->clusters.cluster);
        EXPECT_EQ(clusters->clusters.coefficients, others->clusters.coefficients);
        EXPECT_EQ(clusters->clusters.scales, others->clusters.scales);
    }
}

std::string gloss_complaint(const std::filesystem::path& path, const ReadOptions& options = {}) {
    try {
        read_paim(path, options);
        return "nothing";
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(PaimGloss, RoundTrips) {
    const TemporaryDirectory directory;
    for (const GlossVariant& variant : gloss_variants()) {
        SCOPED_TRACE(variant.name);
        write_paim(directory / "x.paim", variant.asset);
        const Asset read = read_paim(directory / "x.paim");
        EXPECT_TRUE(read.complete);
        ASSERT_TRUE(read.moving().gloss.has_value());
        expect_equal_gloss(*read.moving().gloss, *variant.asset.moving().gloss);
        EXPECT_EQ(read.moving().transfer->matrix.mean,
                  variant.asset.moving().transfer->matrix.mean);
        EXPECT_EQ(read.provenance_json, variant.asset.provenance_json);
        write_paim(directory / "y.paim", read);
        EXPECT_EQ(read_file(directory / "x.paim", 1 << 20),
                  read_file(directory / "y.paim", 1 << 20));
    }
}

// Turns of frames are there or not, whatever numbers the transfer has.
TEST(PaimGloss, HasTurnsOfFrames) {
    const TemporaryDirectory directory;
    const std::vector<Vec3f> turns{{0.5f, 0, -0.25f}, {0, 0, 0}, {1, 2, -1}, {0, 0.001f, 0}};
    for (GlossVariant& variant : gloss_variants()) {
        SCOPED_TRACE(variant.name);
        CodedGloss& gloss = *variant.asset.moving().gloss;
        gloss.frame_turns = frame_turns(std::span(turns).first(gloss.num_rows));
        write_paim(directory / "x.paim", variant.asset);
        const Asset read = read_paim(directory / "x.paim");
        expect_equal_gloss(*read.moving().gloss, gloss);
        EXPECT_EQ(gloss_asset(read).moving().frame_turns, gloss.frame_turns);
    }
}

TEST(PaimGloss, OfStillPartsRoundTrips) {
    const TemporaryDirectory directory;
    for (const bool integers : {false, true}) {
        Asset gloss = make_gloss_alone(1, false, integers);
        const auto make_still = integers ? make_quantised_still : make_example_still;
        gloss.parts.push_back(make_still(gloss.moving().layout));
        gloss.still()->frame_turns = frame_turns(
            std::vector<Vec3f>(gloss.still()->topology.num_vertices, Vec3f(0.25f, -0.5f, 1.0f)));
        Asset whole = make_example_asset(2, 1);
        whole.parts.push_back(make_still(whole.moving().layout));
        whole = with_gloss(std::move(gloss), std::move(whole));
        ASSERT_TRUE(whole.still()->gloss.has_value());
        write_paim(directory / "x.paim", whole);
        const Asset read = read_paim(directory / "x.paim");
        ASSERT_TRUE(read.still()->gloss.has_value());
        expect_equal_gloss(*read.still()->gloss, *whole.still()->gloss);
    }
}

TEST(PaimGloss, IsAnAssetOfItsOwn) {
    const Asset alone = make_gloss_alone(3, true, true);
    const Asset again = gloss_asset(with_gloss(alone));
    EXPECT_EQ(again.moving().layout, alone.moving().layout);
    EXPECT_EQ(again.moving().topology, alone.moving().topology);
    EXPECT_EQ(again.moving().albedo.values, alone.moving().albedo.values);
    EXPECT_EQ(again.moving().transfer->matrix, alone.moving().transfer->matrix);
    EXPECT_EQ(again.provenance_json, alone.provenance_json);
    const Asset partial = gloss_asset(with_partial_gloss());
    EXPECT_EQ(partial.moving().topology.num_vertices, 3u);
    EXPECT_EQ(partial.moving().topology.triangles.size(), 1u);
    const LowRank positions = make_example_asset(2, 1).moving().positions;
    for (size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(partial.moving().positions.mean[axis * 3], positions.mean[axis * 4 + 3]);
        EXPECT_EQ(partial.moving().positions.components[1][axis * 3 + 1],
                  positions.components[1][axis * 4]);
    }
}

// Files of glossy transfer alone are for joining.
TEST(PaimGloss, AloneIsReadOnlyWhereItIsAskedFor) {
    const TemporaryDirectory directory;
    const Asset alone = make_gloss_alone(1, true, false);
    write_paim(directory / "x.paim", alone);
    EXPECT_NE(gloss_complaint(directory / "x.paim").find("transfer of kind 'glossy'"),
              std::string::npos);
    ReadOptions options;
    options.kind = TransferKind::glossy;
    EXPECT_EQ(read_paim(directory / "x.paim", options).moving().layout, alone.moving().layout);
    write_paim(directory / "y.paim", make_example_asset(2, 1));
    EXPECT_NE(gloss_complaint(directory / "y.paim", options), "nothing");
}

TEST(PaimGloss, PrefixesHaveItsComponentsOneByOne) {
    const TemporaryDirectory directory;
    const Asset asset = with_gloss(make_gloss_alone(1, false, false));
    write_paim(directory / "x.paim", asset);
    const std::vector<Prefix> prefixes = read_prefixes(directory / "x.paim");
    EXPECT_EQ(prefixes.front().gloss_components, 0u);
    EXPECT_EQ(prefixes.back().gloss_components, 3u);
    for (const Prefix& prefix : prefixes) {
        ReadOptions options;
        options.prefix = true;
        options.most_bytes = prefix.size_bytes;
        const Asset read = read_paim(directory / "x.paim", options);
        EXPECT_EQ(read.moving().gloss->transfer->matrix.num_components, prefix.gloss_components);
        EXPECT_EQ(read.complete, prefix == prefixes.back());
    }
}

TEST(PaimGloss, RefusesRowsThatAreNoVertices) {
    const TemporaryDirectory directory;
    for (const uint32_t wrong : {4u, 0u}) {  // beyond the vertices, and the second row again
        Asset asset = with_partial_gloss();
        asset.moving().gloss->vertices[0] = wrong;
        write_paim(directory / "x.paim", asset);
        EXPECT_NE(gloss_complaint(directory / "x.paim").find("expected different ones from 0 to 3"),
                  std::string::npos);
    }
}

TEST(PaimGloss, RefusesNumbersThatDoNotFit) {
    const TemporaryDirectory directory;
    const auto expect_refusal = [&](const auto& change, const std::string& part) {
        Asset asset = with_partial_gloss();
        change(*asset.moving().gloss);
        write_paim(directory / "x.paim", asset);
        const std::string text = gloss_complaint(directory / "x.paim");
        EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    expect_refusal([](CodedGloss& gloss) { gloss.num_rows = 5; }, "'rows': expected 1 to 4, got 5");
    expect_refusal([](CodedGloss& gloss) { gloss.layout.out_bands = 9; },
                   "'out_bands': expected 1 to 8, got 9");
    expect_refusal([](CodedGloss& gloss) { gloss.layout.in_bands = 2; }, "expected 12 x 3");
    expect_refusal([](CodedGloss& gloss) { gloss.layout.channels = 2; }, "2 transfer channels");
    expect_refusal([](CodedGloss& gloss) { gloss.tint.values.resize(2); },
                   "expected 1 or 3 colours");
}

}  // namespace
}  // namespace paim
