// Errors of limits against numbers worked out by hand, and the history of one vertex.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "paim/base/tbb_parallel.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/mesh_decoder.h"
#include "player/inspect/false_color.h"
#include "player/inspect/surface_colors.h"
#include "player/inspect/vertex_history.h"
#include "tests/player/inspect_asset.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr SurfaceView kErrorViews[] = {SurfaceView::transfer_error, SurfaceView::radiance_error,
                                       SurfaceView::position_error};

std::vector<std::shared_ptr<const Asset>> both_codecs() {
    TestAssetOptions options;
    options.channels = 3;
    std::vector<std::shared_ptr<const Asset>> assets{shared(make_test_asset(options))};
    options.num_clusters = 4;
    options.cluster_components = 2;
    assets.push_back(shared(make_test_asset(options)));
    return assets;
}

// Vertex 3 alone changes: 1, 1, 1 and 2 in pose 0, 1.5 in pose 1.
Asset one_vertex_changes() {
    return square_asset(1, 1, {1, 1, 1, 1}, {0, 0, 0, 1});
}

constexpr DecodeLimits kNoComponents{.geometry_components = 0, .transfer_components = 0};

TEST(LimitErrors, OfAllThatTheFileHasAreZero) {
    for (const auto& asset : both_codecs()) {
        SurfaceColors colors(asset);
        colors.set_light(DistantLight(make_test_light(5)));
        for (const SurfaceView view : kErrorViews) {
            const ColoredSurface& surface = colors.paint({.view = view, .time = 1.25});
            for (const float error : surface.values[0]) EXPECT_EQ(error, 0.0f);
            EXPECT_EQ(surface.colors[0][5], heat_color(0.0f));
            ASSERT_TRUE(surface.legend.worst && surface.legend.mean_error);
            EXPECT_EQ(surface.legend.worst->value, 0.0f);
            EXPECT_EQ(*surface.legend.mean_error, 0.0);
            EXPECT_EQ(surface.legend.note,
                      "The limits show all that the file has: every error is zero.");
        }
        // With less of anything there are errors.
        const std::pair<SurfaceView, DecodeLimits> less[] = {
            {SurfaceView::position_error, {.geometry_components = 2}},
            {SurfaceView::transfer_error, {.transfer_components = 4}},
            {SurfaceView::radiance_error, {.transfer_components = 4}},
            {SurfaceView::transfer_error, {.bands = 4}},
            {SurfaceView::radiance_error, {.bands = 4}}};
        for (const auto& [view, limits] : less) {
            const Legend legend =
                colors.paint({.view = view, .time = 1.25, .limits = limits}).legend;
            EXPECT_GT(legend.worst->value, 0.0f);
            EXPECT_EQ(legend.note, "");
        }
        const Legend other =
            colors.paint({.view = SurfaceView::position_error, .limits = {.bands = 4}}).legend;
        EXPECT_EQ(other.note, "What the limits leave out changes nothing here in this pose.");
    }
}

// Norm of the difference of two poses at vertex v, of all that the first has.
double distance(const DecodedPose& whole, const DecodedPose* limited, size_t v) {
    const size_t num_vertices = whole.positions.size() / 3;
    double sum = 0.0;
    for (uint32_t channel = 0; channel < whole.layout.channels; ++channel) {
        for (uint32_t i = 0; i < whole.layout.num_coefficients(); ++i) {
            double value = whole.transfer[whole.layout.plane(channel, i) * num_vertices + v];
            if (limited != nullptr && i < limited->layout.num_coefficients()) {
                value -= limited->transfer[limited->layout.plane(channel, i) * num_vertices + v];
            }
            sum += value * value;
        }
    }
    return std::sqrt(sum);
}

TEST(LimitErrors, OfTheTransferAreDifferencesOfDecodedPoses) {
    TestAssetOptions options;
    options.bands = 3;
    options.channels = 3;
    options.num_rings = 50;  // 5,100 vertices, two pieces of work
    for (const uint32_t num_groups : {0u, 5u}) {
        options.num_clusters = num_groups;
        options.cluster_components = num_groups > 0 ? 2 : 0;
        const auto asset = shared(make_test_asset(options));
        const DecodeLimits limits{.transfer_components = 3, .bands = 2, .vertex_components = 1};
        LimitErrors errors(asset);
        const std::vector<float>& measured = errors.measure(ErrorOf::transfer, 1.75, limits)[0];
        MeshDecoder decoder(asset->moving());
        DecodedPose whole, limited;
        decoder.decode(1.75, {}, whole);
        decoder.decode(1.75, limits, limited);
        double sum = 0.0;
        for (size_t v = 0; v < measured.size(); ++v) {
            sum += std::pow(distance(whole, nullptr, v), 2.0);
        }
        const double rms = std::sqrt(sum / static_cast<double>(measured.size()));
        for (size_t v = 0; v < measured.size(); ++v) {
            EXPECT_NEAR(measured[v], distance(whole, &limited, v) / rms, 1e-6);
        }
    }
}

TEST(LimitErrors, OfTheTransferAreFractionsOfItsRms) {
    SurfaceColors colors(shared(one_vertex_changes()));
    const ColoredSurface& surface =
        colors.paint({.view = SurfaceView::transfer_error, .limits = kNoComponents});
    const float expected = 1.0f / std::sqrt((1 + 1 + 1 + 4) / 4.0f);
    EXPECT_EQ(surface.values[0][0], 0.0f);
    EXPECT_NEAR(surface.values[0][3], expected, 1e-6f);
    EXPECT_EQ(surface.legend.worst->part, 0u);
    EXPECT_EQ(surface.legend.worst->vertex, 3u);
    EXPECT_EQ(surface.legend.worst->value, surface.values[0][3]);
    EXPECT_EQ(surface.legend.highest, surface.values[0][3]);
    EXPECT_NEAR(*surface.legend.mean_error, expected / 4.0f, 1e-6);
    EXPECT_EQ(surface.colors[0][3], heat_color(1.0f));
    EXPECT_EQ(surface.colors[0][2], heat_color(0.0f));
    // Between the poses the vertex has 1.75.
    const ColoredSurface& between = colors.paint(
        {.view = SurfaceView::transfer_error, .time = 0.5, .limits = kNoComponents, .scale = 2.0f});
    EXPECT_NEAR(between.values[0][3], 0.75f / std::sqrt((3.0f + 1.75f * 1.75f) / 4.0f), 1e-6f);
    EXPECT_EQ(between.legend.highest, 2.0f);
    EXPECT_EQ(between.colors[0][3], heat_color(between.values[0][3] / 2.0f));
}

// The vertices have norms of 5, 0, 0 and 13, of which 3 and 5 are in band 0.
TEST(LimitErrors, OfDroppedBandsAreAllThatIsInThem) {
    SurfaceColors colors(shared(square_asset(
        2, 1, {3, 0, 0, 5, 0, 0, 0, 12, 4, 0, 0, 0, 0, 0, 0, 0}, std::vector<float>(16))));
    const ColoredSurface& surface =
        colors.paint({.view = SurfaceView::transfer_error, .limits = {.bands = 1}});
    const float rms = std::sqrt((25.0f + 169.0f) / 4.0f);
    EXPECT_NEAR(surface.values[0][0], 4.0f / rms, 1e-6f);
    EXPECT_NEAR(surface.values[0][3], 12.0f / rms, 1e-6f);
    EXPECT_EQ(surface.values[0][1], 0.0f);
}

// The light has nothing in band 1, so that the radiance lacks nothing without it.
TEST(LimitErrors, OfRadianceDependOnTheLight) {
    SurfaceColors colors(
        shared(square_asset(2, 3, {1, 1, 1, 1, 9, 9, 9, 9, 0, 0, 0, 0, 0, 0, 0, 0,  //
                                   1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,  //
                                   1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
                            {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,  //
                             0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,  //
                             0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0})));
    LightCoefficients light{1, {Vec3f(1, 2, 2)}};
    colors.set_light(DistantLight(light));
    SurfaceQuery query{.view = SurfaceView::radiance_error, .limits = {.bands = 1}};
    EXPECT_EQ(colors.paint(query).legend.worst->value, 0.0f);
    query.limits = kNoComponents;
    // Radiance of half of (1, 2, 2), and at vertex 3 of (1, 6, 2). The light and the vertex lack 4.
    const float rms = 0.5f * std::sqrt((3 * 9 + 41) / 4.0f);
    const ColoredSurface& surface = colors.paint(query);
    EXPECT_NEAR(surface.values[0][3], 0.5f * 4.0f / rms, 1e-6f);
    EXPECT_EQ(surface.values[0][0], 0.0f);
    light = {2, {Vec3f(1, 2, 2), Vec3f(1, 0, 0), Vec3f(0, 0, 0), Vec3f(0, 0, 0)}};
    colors.set_light(DistantLight(light));
    query.limits = {.bands = 1};
    EXPECT_GT(colors.paint(query).legend.worst->value, 0.0f);
}

TEST(LimitErrors, OfPositionsAreFractionsOfTheDiagonal) {
    Asset asset = one_vertex_changes();
    SurfaceQuery query{.view = SurfaceView::position_error, .limits = kNoComponents};
    const auto of_vertex_3 = [&] { return SurfaceColors(shared(asset)).paint(query).values[0][3]; };
    EXPECT_NEAR(of_vertex_3(), 0.5f / std::sqrt(25.25f), 1e-6f);
    query.time = 1.0;
    EXPECT_NEAR(of_vertex_3(), 0.25f / std::sqrt(25.0625f), 1e-6f);
    // The body is the first three vertices, which lie in a plane; the last one is a floor.
    asset.moving().num_following = 3;
    EXPECT_NEAR(of_vertex_3(), 0.25f / 5.0f, 1e-6f);
    // A body without vertices is all of them.
    asset.moving().num_following = 0;
    EXPECT_NEAR(of_vertex_3(), 0.25f / std::sqrt(25.0625f), 1e-6f);
    // An exception, with a singular value of 0, is an outlier: bounds are those without it.
    asset.moving().num_following = kAllVertices;
    asset.moving().positions.singular_values = {0.0};
    EXPECT_NEAR(of_vertex_3(), 0.25f / 5.0f, 1e-6f);
}

TEST(LimitErrors, DoNotCountVerticesOfNoFace) {
    Asset asset = one_vertex_changes();
    asset.moving().topology.triangles.pop_back();
    SurfaceColors colors(shared(asset));
    const Legend legend =
        colors.paint({.view = SurfaceView::transfer_error, .limits = kNoComponents}).legend;
    EXPECT_EQ(legend.worst->value, 0.0f);
    EXPECT_EQ(*legend.mean_error, 0.0);
    EXPECT_EQ(legend.note, "What the limits leave out changes nothing here in this pose.");

    // Nor do they count in the RMS: 1, 1 and 2.
    Asset large = square_asset(1, 1, {1, 1, 1, 100}, {0, 0, 1, 0});
    large.moving().topology.triangles.pop_back();
    SurfaceColors of_large(shared(std::move(large)));
    EXPECT_NEAR(of_large.paint({.view = SurfaceView::transfer_error, .limits = kNoComponents})
                    .legend.worst->value,
                1.0f / std::sqrt(6.0f / 3.0f), 1e-6f);
}

TEST(LimitErrors, OfEquallyWrongVerticesTheFirstIsTheWorst) {
    SurfaceColors colors(shared(square_asset(1, 1, {1, 1, 1, 1}, {0, 1, 0, 1})));
    const SurfaceQuery query{.view = SurfaceView::transfer_error, .limits = kNoComponents};
    EXPECT_EQ(colors.paint(query).legend.worst->vertex, 1u);
}

TEST(LimitErrors, AreNoneWhereTheLimitsShowAll) {
    const auto grouped = both_codecs()[1];  // 3 and 5 components, 2 of vertices, 5 bands
    EXPECT_TRUE(show_all(*grouped, {}));
    EXPECT_TRUE(show_all(*grouped, {3, 5, 5, 2}));
    EXPECT_FALSE(show_all(*grouped, {2, 5, 5, 2}));
    EXPECT_FALSE(show_all(*grouped, {3, 4, 5, 2}));
    EXPECT_FALSE(show_all(*grouped, {3, 5, 4, 2}));
    EXPECT_FALSE(show_all(*grouped, {3, 5, 5, 1}));
}

TEST(LimitErrors, OfAZeroAreInfinite) {
    // The component takes the mean away in pose 0.
    SurfaceColors colors(shared(square_asset(1, 1, {0, 0, 0, 1}, {0, 0, 0, -1})));
    const ColoredSurface& surface =
        colors.paint({.view = SurfaceView::transfer_error, .limits = kNoComponents});
    EXPECT_TRUE(std::isinf(surface.values[0][3]));
    EXPECT_EQ(surface.values[0][0], 0.0f);
}

// A damaged value of one vertex: in its last component over the poses, or of its own.
TEST(LimitErrors, TheWorstVertexIsTheDamagedOne) {
    for (auto& whole : both_codecs()) {
        Asset asset = *whole;
        CodedMesh& mesh = asset.moving();
        DecodeLimits limits;
        const uint32_t damaged = mesh.topology.num_vertices / 2;
        if (auto* const grouped = mesh.transfer.as<CpcaTransfer>()) {
            std::vector<float> coefficients(mesh.topology.num_vertices, 0.001f);
            coefficients[damaged] = 2.0f;
            grouped->clusters.coefficients.back() = StoredValues(std::move(coefficients));
            limits.vertex_components = 1;
        } else {
            LowRank& matrix = mesh.transfer->matrix;
            std::vector<float> component(matrix.num_rows(), 0.0f);
            component[size_t{2} * matrix.num_points + damaged] = 3.0f;
            matrix.components.back() = StoredValues(std::move(component));
            limits.transfer_components = matrix.num_components - 1;
        }
        SurfaceColors colors(shared(std::move(asset)));
        const Legend legend =
            colors.paint({.view = SurfaceView::transfer_error, .time = 2.0, .limits = limits})
                .legend;
        EXPECT_EQ(legend.worst->vertex, damaged);
        EXPECT_GT(legend.worst->value, 0.0f);
    }
}

TEST(LimitErrors, AreRelativeToTheVerticesOfAllParts) {
    Asset asset = one_vertex_changes();
    asset.parts.push_back(asset.moving());
    CodedMesh& still = asset.parts.back();
    still.positions.keep_components(0);
    still.transfer = SvdTransfer(LowRank::still(1, std::vector<float>(4, 10.0f)));
    SurfaceColors colors(shared(std::move(asset)));
    const ColoredSurface& surface =
        colors.paint({.view = SurfaceView::transfer_error, .limits = kNoComponents});
    EXPECT_NEAR(surface.values[0][3], 1.0f / std::sqrt((7.0f + 400.0f) / 8.0f), 1e-6f);
    EXPECT_EQ(surface.values[1], std::vector<float>(4, 0.0f));
}

TEST(LimitErrors, AreTheSameOnAnyNumberOfThreads) {
    TestAssetOptions options;
    options.num_rings = 60;  // 7,320 vertices, two pieces of work
    for (const uint32_t num_groups : {0u, 5u}) {
        options.num_clusters = num_groups;
        options.cluster_components = num_groups > 0 ? 2 : 0;
        const auto asset = shared(make_test_asset(options));
        std::vector<std::vector<float>> values;
        for (const int num_threads : {1, 0}) {
            const ThreadLimit limit(num_threads);
            SurfaceColors colors(asset);
            colors.set_light(DistantLight(make_test_light(5)));
            for (const SurfaceView view : kErrorViews) {
                values.push_back(
                    colors.paint({.view = view, .time = 3.5, .limits = {2, 3, 4}}).values[0]);
            }
        }
        for (size_t j = 0; j < 3; ++j) EXPECT_EQ(values[j], values[j + 3]);
    }
}

TEST(SequenceScale, IsTheLargestOfThePoses) {
    for (const auto& asset : both_codecs()) {
        SurfaceColors colors(asset);
        colors.set_light(DistantLight(make_test_light(5)));
        for (const SurfaceView view : {SurfaceView::coefficient, SurfaceView::transfer_error,
                                       SurfaceView::radiance_error, SurfaceView::position_error}) {
            SurfaceQuery query{.view = view, .limits = {1, 2, 4}, .coefficient = 3};
            float largest = 0.0f;
            for (uint32_t p = 0; p < asset->num_poses(); ++p) {
                query.time = p;
                largest = std::max(largest, colors.paint(query).legend.highest);
            }
            EXPECT_EQ(colors.sequence_scale(query), largest);
            EXPECT_GT(largest, 0.0f);
        }
        EXPECT_EQ(colors.sequence_scale({.view = SurfaceView::normals, .limits = {1, 2, 4}}), 0.0f);
    }
}

TEST(VertexHistory, IsWhatTheSurfaceShowsAtEveryPose) {
    constexpr ErrorOf kErrors[] = {ErrorOf::transfer, ErrorOf::radiance, ErrorOf::position};
    for (const auto& asset : both_codecs()) {
        SurfaceColors colors(asset);
        colors.set_light(DistantLight(make_test_light(5)));
        for (size_t j = 0; j < 3; ++j) {
            SurfaceQuery query{.view = kErrorViews[j], .limits = {1, 2, 4}};
            VertexHistory history(colors.errors(), kErrors[j], 0, 11, query.limits);
            EXPECT_EQ(history.times().size(), 6u);
            EXPECT_FALSE(history.done());
            EXPECT_FALSE(history.advance(size_t{2}));
            EXPECT_EQ(history.values().size(), 2u);
            // Another pose is shown in between.
            query.time = 5.0;
            const float last = colors.paint(query).values[0][11];
            EXPECT_TRUE(history.advance(size_t{9}));
            ASSERT_EQ(history.values().size(), 6u);
            EXPECT_EQ(history.values().back(), last);
            for (size_t p = 0; p < 6; ++p) {
                query.time = history.times()[p];
                EXPECT_EQ(query.time, static_cast<double>(p));
                EXPECT_EQ(history.values()[p], colors.paint(query).values[0][11]);
            }
        }
    }
}

TEST(VertexHistory, SamplesLongSequencesAndAdvancesByTime) {
    Asset asset = one_vertex_changes();
    LowRank& matrix = asset.moving().transfer->matrix;
    matrix.num_poses = 1000;
    matrix.weights.assign(1000, 1.0f);
    LimitErrors errors(shared(std::move(asset)));
    VertexHistory history(errors, ErrorOf::transfer, 0, 3, kNoComponents);
    ASSERT_EQ(history.times().size(), size_t{VertexHistory::kMostPoses});
    EXPECT_EQ(history.times().front(), 0.0);
    EXPECT_EQ(history.times().back(), 999.0);
    for (size_t j = 1; j < history.times().size(); ++j) {
        const double step = history.times()[j] - history.times()[j - 1];
        EXPECT_TRUE(step == 1.0 || step == 2.0) << step;
    }
    EXPECT_FALSE(history.advance(std::chrono::milliseconds(0)));
    EXPECT_EQ(history.values().size(), 1u);
    EXPECT_TRUE(history.advance(std::chrono::hours(1)));
    EXPECT_EQ(history.values().size(), size_t{VertexHistory::kMostPoses});
    EXPECT_NEAR(history.values().back(), 1.0f / std::sqrt(7.0f / 4.0f), 1e-6f);
}

}  // namespace
}  // namespace paim::player
