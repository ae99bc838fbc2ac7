// Limits, comparisons and views of the surface, as the window shows them.
#include <algorithm>
#include <cmath>

#include "paim/codec/mesh_decoder.h"
#include "paim/mesh/planes.h"
#include "player/inspect/false_color.h"
#include "player/inspect/limit_errors.h"
#include "player/inspect/pick.h"
#include "tests/player/window_fixture.h"

namespace paim::player {
namespace {

struct SurfaceCase {
    const char* name;
    uint32_t num_clusters, cluster_components;
};

class WindowSurfaceTest : public WindowTest, public testing::WithParamInterface<SurfaceCase> {
  protected:
    static Asset make_asset() {
        TestAssetOptions options;
        options.num_clusters = GetParam().num_clusters;
        options.cluster_components = GetParam().cluster_components;
        return make_test_asset(options);
    }
    // The picture with these limits, not compared with anything.
    ScreenPicture picture_within(const DecodeLimits& limits) {
        ViewState plain = view();
        plain.comparison = Comparison::none;
        plain.limits = limits;
        return picture_of(plain);
    }
    // Compares pixels of vertices that are seen with colours of vertices, interpolated over the
    // triangle there. Returns how many it has compared.
    int expect_colors(const std::vector<Vec3f>& colors);
};

INSTANTIATE_TEST_SUITE_P(Codecs, WindowSurfaceTest,
                         testing::Values(SurfaceCase{"Svd", 0, 0}, SurfaceCase{"Cpca", 3, 2}),
                         [](const auto& codec) { return codec.param.name; });

int WindowSurfaceTest::expect_colors(const std::vector<Vec3f>& colors) {
    const ScreenPicture picture = screen();
    const CodedMesh& mesh = presenter().asset().moving();
    DecodedPose pose;
    MeshDecoder(mesh).decode(presenter().time(view()), view().limits, pose);
    const PickSurface surface{&mesh.topology, pose.positions};
    const float aspect = static_cast<float>(picture.width) / static_cast<float>(picture.height);
    int num_compared = 0;
    for (uint32_t v = 0; v < mesh.topology.num_vertices; ++v) {
        const auto [place_x, place_y] = place_of({0, v});
        const int x = static_cast<int>(place_x), y = static_cast<int>(place_y);
        const auto hit =
            pick(ray_through_pixel(
                     presenter().camera(view()),
                     (static_cast<float>(x) + 0.5f) / static_cast<float>(picture.width),
                     (static_cast<float>(y) + 0.5f) / static_cast<float>(picture.height), aspect),
                 {&surface, 1});
        // In the middle of what is seen: OpenGL moves corners by up to 1/256 pixel, which shows
        // where triangles are seen edge on.
        if (!hit || hit->vertex != v || std::hypot(x - 200, y - 150) > 90) continue;
        const Triangle& triangle = mesh.topology.triangles[hit->triangle];
        Vec3f linear = Vec3f::Zero();
        for (int corner = 0; corner < 3; ++corner) {
            linear += hit->barycentric[corner] * colors[triangle[static_cast<size_t>(corner)]];
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(picture.at(x, y)[static_cast<size_t>(c)], ToneCurve().apply(linear[c]), 2)
                << "vertex " << v << " at " << x << ", " << y;
        }
        ++num_compared;
    }
    return num_compared;
}

TEST_P(WindowSurfaceTest, SliderLowersTransferComponents) {
    show(make_asset());
    const ScreenPicture whole = screen();
    press("Tab");
    const auto slider = find_widget("settings", "transfer components");
    ASSERT_TRUE(slider);
    ASSERT_EQ(view().limits.transfer_components, 5u);
    drag({slider->right - 4, slider->y},
         {slider->left + (slider->right - slider->left) / 5, slider->y});
    settle();
    EXPECT_EQ(view().limits.transfer_components, 1u);
    press("Tab");
    DecodeLimits limits = app().session().range().limits;
    limits.transfer_components = 1;
    const ScreenPicture limited = screen();
    EXPECT_LE(largest_difference(limited, picture_within(limits)), kRounding);
    EXPECT_GT(largest_difference(limited, whole), 10);
    // The keys go back to all of them.
    for (int i = 0; i < 6; ++i) press("bracketright");
    EXPECT_EQ(view().limits.transfer_components, 5u);
    EXPECT_EQ(screen(), whole);
}

TEST_P(WindowSurfaceTest, ComparesWithTheWholeFile) {
    show(make_asset());
    for (int i = 0; i < 4; ++i) press("bracketleft");
    const DecodeLimits limits = view().limits, most = app().session().range().limits;
    ASSERT_EQ(limits.transfer_components, 1u);
    const ScreenPicture limited = picture_within(limits), whole = picture_within(most);
    ASSERT_GT(largest_difference(columns(limited, 0, 200), columns(whole, 0, 200)), 10);
    ASSERT_GT(largest_difference(columns(limited, 200, 400), columns(whole, 200, 400)), 10);

    press("x");
    EXPECT_EQ(view().comparison, Comparison::wipe);
    ScreenPicture picture = screen();
    EXPECT_LE(largest_difference(columns(picture, 0, 200), columns(limited, 0, 200)), kRounding);
    EXPECT_LE(largest_difference(columns(picture, 200, 400), columns(whole, 200, 400)), kRounding);
    view().split = 0.25;
    settle();
    picture = screen();
    EXPECT_LE(largest_difference(columns(picture, 0, 100), columns(limited, 0, 100)), kRounding);
    EXPECT_LE(largest_difference(columns(picture, 100, 400), columns(whole, 100, 400)), kRounding);

    press("x");
    EXPECT_EQ(view().comparison, Comparison::side_by_side);
    ViewState plain = view();
    plain.comparison = Comparison::none;
    const auto half = [&](const DecodeLimits& shown) -> ScreenPicture {
        plain.limits = shown;
        const Image image = presenter().render(plain, 200, 300, 1);
        return {200, 300, tone_map(image, plain.tone_curve)};
    };
    picture = screen();
    EXPECT_LE(largest_difference(columns(picture, 0, 200), half(limits)), kRounding);
    EXPECT_LE(largest_difference(columns(picture, 200, 400), half(most)), kRounding);

    press("x");
    EXPECT_LE(largest_difference(screen(), limited), kRounding);
}

TEST_P(WindowSurfaceTest, HeatMapShowsTransferErrors) {
    show(make_asset());
    for (int i = 0; i < 4; ++i) press("bracketleft");
    for (int i = 0; i < 3; ++i) press("v", true);
    ASSERT_EQ(view().surface, SurfaceView::transfer_error);
    LimitErrors errors(presenter().shared_asset());
    const std::vector<float> values = errors.measure(ErrorOf::transfer, 0.0, view().limits)[0];
    const float largest = *std::max_element(values.begin(), values.end());
    std::vector<Vec3f> colors;
    for (const float value : values) colors.push_back(heat_color(value / largest));
    EXPECT_GE(expect_colors(colors), 10);
}

TEST_P(WindowSurfaceTest, HeatMapOfAllComponentsIsZero) {
    show(make_asset());
    for (int i = 0; i < 3; ++i) press("v", true);
    ASSERT_EQ(view().surface, SurfaceView::transfer_error);
    const CodedMesh& mesh = presenter().asset().moving();
    EXPECT_GE(expect_colors({mesh.topology.num_vertices, heat_color(0.0f)}), 10);
    ASSERT_NE(presenter().painter().legend(), nullptr);
    EXPECT_EQ(presenter().painter().legend()->worst->value, 0.0f);
    EXPECT_NE(presenter().painter().legend()->note.find("every error is zero"), std::string::npos);
}

TEST_P(WindowSurfaceTest, CoefficientIsRedAndBlue) {
    show(make_asset());
    const CodedMesh& mesh = presenter().asset().moving();
    ScreenPicture last = screen();
    for (const uint32_t coefficient : {1u, 2u}) {
        press("c");
        ASSERT_EQ(view().surface, SurfaceView::coefficient);
        ASSERT_EQ(view().coefficient, coefficient);
        DecodedPose pose;
        MeshDecoder(mesh).decode(0.0, view().limits, pose);
        const size_t num_vertices = mesh.topology.num_vertices;
        const float* const plane = pose.transfer.data() + coefficient * num_vertices;
        float largest = 0.0f;
        for (size_t v = 0; v < num_vertices; ++v) largest = std::max(largest, std::abs(plane[v]));
        std::vector<Vec3f> colors;
        for (size_t v = 0; v < num_vertices; ++v) colors.push_back(signed_color(plane[v], largest));
        EXPECT_GE(expect_colors(colors), 10);
        EXPECT_GT(largest_difference(screen(), last), 10);
        last = screen();
    }
}

// White on black: of a circle's pixels some are white, wherever it is drawn.
bool has_circle(const ScreenPicture& picture, double x, double y, double radius) {
    constexpr int kPlaces = 32;
    int num_white = 0;
    for (int i = 0; i < kPlaces; ++i) {
        const double angle = 2.0 * kPi * i / kPlaces;
        const DisplayValue& value = picture.at(static_cast<int>(x + radius * std::cos(angle)),
                                               static_cast<int>(y + radius * std::sin(angle)));
        num_white += *std::min_element(value.begin(), value.end()) > 200 ? 1 : 0;
    }
    return num_white > kPlaces / 2;
}

TEST_P(WindowSurfaceTest, LegendAndWorstVertexAreShown) {
    show(make_asset(), {"--size", "760x560"});
    for (int i = 0; i < 4; ++i) press("bracketleft");
    for (int i = 0; i < 3; ++i) press("v", true);
    ASSERT_NE(presenter().painter().legend(), nullptr);
    ASSERT_TRUE(presenter().painter().legend()->worst);
    const PickedVertex worst{presenter().painter().legend()->worst->part,
                             presenter().painter().legend()->worst->vertex};
    // Between the panels.
    view().camera.orbit.target =
        presenter().probe().position(presenter().time(view()), view().limits, worst).cast<double>();
    drag({380, 280}, {420, 310}, 3);
    settle();
    const auto [x, y] = place_of(worst);
    EXPECT_NEAR(x, 420, 1);
    EXPECT_NEAR(y, 310, 1);
    constexpr double kRadius = 0.7 * 13.0;  // of the font
    const ScreenPicture bare = screen();
    EXPECT_FALSE(has_circle(bare, x, y, kRadius));
    press("Tab");
    const ScreenPicture picture = screen();
    EXPECT_TRUE(has_circle(picture, x, y, kRadius));
    // The colours of the scale, from one end to the other, in one row of the upper right corner.
    int num_rows = 0;
    for (int row = 0; row < 150; ++row) {
        int found = 0;
        for (int column = 450; column < 760 && found < 64; ++column) {
            const Vec3f linear = heat_color(static_cast<float>(found) / 63.0f);
            const ToneCurve curve;
            const DisplayValue expected{curve.apply(linear[0]), curve.apply(linear[1]),
                                        curve.apply(linear[2])};
            if (picture.at(column, row) == expected) ++found;
        }
        num_rows += found == 64 ? 1 : 0;
    }
    EXPECT_EQ(num_rows, 13);
}

}  // namespace
}  // namespace paim::player
