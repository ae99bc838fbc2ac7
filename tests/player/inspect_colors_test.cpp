// Colours of views against numbers that are decoded or worked out apart from them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/sh/basis.h"
#include "paim/sh/cosine_lobe.h"
#include "player/inspect/false_color.h"
#include "player/inspect/surface_colors.h"
#include "tests/player/inspect_asset.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

// Small animations of both codecs, with a still part.
std::vector<std::shared_ptr<const Asset>> example_assets(uint32_t channels = 1) {
    TestAssetOptions options;
    options.channels = channels;
    options.albedo_per_vertex = true;
    Asset by_vertex = make_test_asset(options);
    by_vertex.parts.push_back(stand_still(by_vertex.moving(), 3.0f));
    options.num_clusters = 3;
    options.cluster_components = 2;
    Asset by_group = make_test_asset(options);
    by_group.parts.push_back(by_vertex.parts[1]);
    return {shared(std::move(by_vertex)), shared(std::move(by_group))};
}

float sum_of_channels(const DecodedPose& pose, uint32_t v, uint32_t i,
                      const std::vector<float>& weights) {
    const size_t num_vertices = pose.positions.size() / 3;
    float sum = 0.0f;
    for (uint32_t channel = 0; channel < pose.layout.channels; ++channel) {
        sum += weights[channel] * pose.transfer[pose.layout.plane(channel, i) * num_vertices + v];
    }
    return sum;
}

TEST(SurfaceColors, OfACoefficientAreThoseOfTheDecodedNumber) {
    for (const uint32_t channels : {1u, 3u}) {
        for (const auto& asset : example_assets(channels)) {
            SurfaceColors colors(asset);
            const DecodeLimits limits{.transfer_components = 3, .vertex_components = 1};
            const ColoredSurface& surface = colors.paint({.view = SurfaceView::coefficient,
                                                          .time = 2.25,
                                                          .limits = limits,
                                                          .coefficient = 7,
                                                          .channel = 2});
            float largest = 0.0f;
            for (size_t part = 0; part < 2; ++part) {
                DecodedPose pose;
                MeshDecoder(asset->parts[part]).decode(2.25, limits, pose);
                const std::vector<float> weights =
                    channels == 1 ? std::vector<float>{1} : std::vector<float>{0, 0, 1};
                for (uint32_t v = 0; v < surface.values[part].size(); ++v) {
                    const float value = sum_of_channels(pose, v, 7, weights);
                    EXPECT_NEAR(surface.values[part][v], value, 1e-6f);
                    EXPECT_EQ(surface.colors[part][v],
                              signed_color(surface.values[part][v], surface.legend.highest));
                    largest = std::max(largest, std::abs(value));
                }
            }
            EXPECT_EQ(surface.legend.kind, ScaleKind::signed_values);
            EXPECT_NEAR(surface.legend.highest, largest, 1e-6f);
            EXPECT_EQ(surface.legend.lowest, -surface.legend.highest);
            EXPECT_FALSE(surface.legend.worst);
        }
    }
}

TEST(SurfaceColors, OfLuminanceWeighTheChannels) {
    const auto asset = shared(
        square_asset(1, 3, {1, 0, 0, 2, 0, 1, 0, 2, 0, 0, 1, 2}, std::vector<float>(12, 0.0f)));
    SurfaceColors colors(asset);
    const auto& values = colors.paint({.view = SurfaceView::coefficient}).values[0];
    EXPECT_NEAR(values[0], 0.2126f, 1e-6f);
    EXPECT_NEAR(values[1], 0.7152f, 1e-6f);
    EXPECT_NEAR(values[2], 0.0722f, 1e-6f);
    EXPECT_NEAR(values[3], 2.0f, 1e-6f);
}

TEST(SurfaceColors, OfACoefficientBeyondTheBandsAreNeutral) {
    for (const auto& asset : example_assets()) {
        SurfaceColors colors(asset);
        SurfaceQuery query{.view = SurfaceView::coefficient, .coefficient = 9};
        EXPECT_EQ(colors.paint(query).legend.note, "");
        query.limits.bands = 3;
        const ColoredSurface& surface = colors.paint(query);
        EXPECT_EQ(surface.legend.note, "Band 3 is not within the limits.");
        for (const Vec3f& color : surface.colors[0]) EXPECT_EQ(color, signed_color(0.0f, 1.0f));
        query.coefficient = 8;
        EXPECT_EQ(colors.paint(query).legend.note, "");
        query = {.view = SurfaceView::coefficient, .coefficient = 25};  // the file has 5 bands
        EXPECT_EQ(colors.paint(query).legend.highest, 0.0f);
    }
}

// Transfer t_i = λ_l y_i(n) (docs/algorithms/transfer.md), of vertices that are open, half as open,
// and lit by bounces as well.
TEST(SurfaceColors, OfAnOpenVertexIsTheEndOfTheScale) {
    std::vector<float> open(9);
    sh::evaluate_basis(3, Vec3d(0, 0, 1), open);
    std::vector<float> mean;
    for (int i = 0; i < 9; ++i) {
        const float t =
            static_cast<float>(sh::cosine_lobe(sh::band_of(i))) * open[static_cast<size_t>(i)];
        mean.insert(mean.end(), {t, 0.5f * t, 1.25f * t, 0.0f});
    }
    SurfaceColors colors(shared(square_asset(3, 1, mean, std::vector<float>(36, 0.0f))));
    const ColoredSurface& surface = colors.paint({.view = SurfaceView::open_fraction});
    EXPECT_NEAR(surface.values[0][0], 1.0f, 1e-6f);
    EXPECT_NEAR(surface.values[0][1], 0.5f, 1e-6f);
    EXPECT_NEAR(surface.values[0][2], 1.25f, 1e-6f);
    EXPECT_EQ(surface.values[0][3], 0.0f);
    EXPECT_EQ(surface.legend.highest, 1.0f);
    EXPECT_EQ(surface.colors[0][1], heat_color(surface.values[0][1]));
    EXPECT_EQ(surface.colors[0][2], heat_color(1.0f));
    EXPECT_EQ(surface.colors[0][3], heat_color(0.0f));
    EXPECT_EQ(surface.legend.note,
              "Vertices above 1.05, where light that bounces adds to the open sky: 1.");
}

TEST(SurfaceColors, OfLightAreTheRadianceWithinTheLimits) {
    for (const auto& asset : example_assets(3)) {
        SurfaceColors colors(asset);
        const LightCoefficients light = make_test_light(5);
        colors.set_light(DistantLight(light));
        const DecodeLimits limits{.transfer_components = 2, .bands = 4};
        const ColoredSurface& surface = colors.paint({.time = 1.5, .limits = limits});
        for (size_t part = 0; part < 2; ++part) {
            const std::vector<Vec3f> radiance =
                vertex_radiance(asset->parts[part], 1.5, limits, light);
            ASSERT_EQ(surface.colors[part].size(), radiance.size());
            for (size_t v = 0; v < radiance.size(); ++v) {
                EXPECT_LT((surface.colors[part][v] - radiance[v]).norm(), 1e-5f);
            }
        }
        EXPECT_EQ(surface.legend.kind, ScaleKind::none);
        EXPECT_TRUE(surface.values[0].empty());
    }
}

TEST(SurfaceColors, OfAlbedoAreTheAlbedo) {
    const auto asset = example_assets()[0];
    SurfaceColors colors(asset);
    EXPECT_EQ(colors.paint({.view = SurfaceView::albedo}).colors[0], asset->moving().albedo.values);
    const auto square = shared(square_asset(1, 1, {1, 1, 1, 1}, {0, 0, 0, 0}));
    EXPECT_EQ(SurfaceColors(square).paint({.view = SurfaceView::albedo}).colors[0],
              std::vector<Vec3f>(4, Vec3f::Constant(0.5f)));
}

TEST(SurfaceColors, OfGroupsAreThoseOfTheCodec) {
    const auto assets = example_assets();
    const auto& groups = assets[1]->moving().transfer.as<CpcaTransfer>()->clusters.cluster;
    SurfaceColors by_group(assets[1]);
    const ColoredSurface& surface = by_group.paint({.view = SurfaceView::groups});
    for (size_t v = 0; v < groups.size(); ++v) {
        EXPECT_EQ(surface.colors[0][v], category_color(groups[v]));
    }
    EXPECT_EQ(surface.legend.note, "Every vertex of the still part has values of its own.");
    SurfaceColors by_vertex(assets[0]);
    const ColoredSurface& plain = by_vertex.paint({.view = SurfaceView::groups});
    for (const Vec3f& color : plain.colors[0]) EXPECT_EQ(color, category_color(0));
    EXPECT_EQ(plain.legend.note, "Every vertex has values of its own: there are no groups.");
}

TEST(SurfaceColors, OfNormalsAreThoseWithinTheLimits) {
    SurfaceColors colors(shared(square_asset(1, 1, {1, 1, 1, 1}, {0, 0, 0, 0})));
    EXPECT_FALSE(colors.paint({.view = SurfaceView::coefficient}).values[0].empty());
    const ColoredSurface& surface = colors.paint({.view = SurfaceView::normals});
    EXPECT_TRUE(surface.values[0].empty());
    EXPECT_GT((surface.colors[0][3] - Vec3f(0.5f, 0.5f, 1.0f)).norm(), 0.01f);
    colors.paint({.view = SurfaceView::normals, .limits = {.geometry_components = 0}});
    EXPECT_LT((surface.colors[0][3] - Vec3f(0.5f, 0.5f, 1.0f)).norm(), 1e-6f);
}

TEST(SurfaceColors, OfNormalsTurnWithTheBodyButNotWithItsFloor) {
    Asset asset = square_asset(1, 1, {1, 1, 1, 1}, {0, 0, 0, 0});
    CodedMesh& mesh = asset.moving();
    mesh.positions.keep_components(0);
    const auto at = [](const Asset& of, double time) {
        return SurfaceColors(shared(of))
            .paint({.view = SurfaceView::normals, .time = time})
            .colors[0];
    };
    EXPECT_LT((at(asset, 1.0)[3] - Vec3f(0.5f, 0.5f, 1.0f)).norm(), 1e-6f);
    // A quarter turn about +Y takes +Z to +X.
    mesh.root_motion.resize(2);
    mesh.root_motion[1].rotation = Eigen::AngleAxisd(kPi / 2, Vec3d::UnitY());
    EXPECT_LT((at(asset, 0.0)[0] - Vec3f(0.5f, 0.5f, 1.0f)).norm(), 1e-6f);
    EXPECT_LT((at(asset, 1.0)[3] - Vec3f(1.0f, 0.5f, 0.5f)).norm(), 1e-6f);
    mesh.num_following = 3;
    EXPECT_LT((at(asset, 1.0)[2] - Vec3f(1.0f, 0.5f, 0.5f)).norm(), 1e-6f);
    EXPECT_LT((at(asset, 1.0)[3] - Vec3f(0.5f, 0.5f, 1.0f)).norm(), 1e-6f);
}

// Two faces at a right angle that meet at doubled vertices share a normal there; without the second
// face nothing is shared.
TEST(SurfaceColors, OfNormalsGoOnAcrossSeams) {
    Asset asset;
    CodedMesh& mesh = asset.moving();
    mesh.layout.in_bands = 1;
    mesh.topology = {6, {{0, 1, 2}, {4, 3, 5}}};
    mesh.positions = LowRank::still(
        3, std::vector<float>{0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, -1});
    mesh.transfer = SvdTransfer(LowRank::still(1, std::vector<float>(6, 1.0f)));
    const auto normals = [&](double time = 0.0) {
        return SurfaceColors(shared(asset))
            .paint({.view = SurfaceView::normals, .time = time})
            .colors[0];
    };
    const std::vector<Vec3f> joined = normals();
    EXPECT_EQ(joined[0], joined[3]);
    EXPECT_EQ(joined[1], joined[4]);
    EXPECT_NE(joined[0], joined[2]);
    // A face counts once.
    mesh.topology.triangles.push_back({0, 1, 2});
    EXPECT_EQ(normals(), joined);
    mesh.topology.triangles.pop_back();
    // The doubled vertices part in one of two poses.
    LowRank moving = mesh.positions;
    moving.num_poses = 2;
    moving.num_components = 1;
    std::vector<float> component(18, 0.0f);
    component[9] = 1.0f;  // y of vertex 3
    component[10] = 1.0f;
    moving.components = {StoredValues(component)};
    moving.weights = {0.0f, 1.0f};
    std::swap(mesh.positions, moving);
    EXPECT_NE(normals()[0], normals()[3]);
    mesh.positions.weights = {1.0f, 0.0f};
    EXPECT_NE(normals(1.0)[0], normals(1.0)[3]);
    std::swap(mesh.positions, moving);
    mesh.topology.triangles.pop_back();
    EXPECT_EQ(normals()[0], normals()[2]);
}

TEST(SurfaceColors, OfTheShapeAreGreyAndBrightestTowardsTheLight) {
    const auto asset = example_assets()[0];
    SurfaceColors colors(asset);
    const std::vector<Vec3f> normals = colors.paint({.view = SurfaceView::normals}).colors[0];
    const std::vector<Vec3f> shape =
        colors.paint({.view = SurfaceView::shape, .headlight = {0, 3, 0}}).colors[0];
    for (size_t v = 1; v < shape.size(); ++v) {
        EXPECT_EQ(shape[v].x(), shape[v].y());
        EXPECT_EQ(shape[v].x(), shape[v].z());
        EXPECT_GE(shape[v].x(), 0.05f);
        EXPECT_LE(shape[v].x(), 1.0f);
        // Half Lambert rises with the cosine, which is that of y.
        if (normals[v].y() > normals[v - 1].y() + 1e-3f) {
            EXPECT_GT(shape[v].x(), shape[v - 1].x());
        }
    }
}

}  // namespace
}  // namespace paim::player
