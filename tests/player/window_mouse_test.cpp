// What the mouse does in the picture.
#include <algorithm>
#include <cmath>

#include "player/inspect/limit_errors.h"
#include "player/inspect/vertex_history.h"
#include "tests/player/window_fixture.h"

namespace paim::player {
namespace {

class WindowMouseTest : public WindowTest {};

// What is seen of the body before the backdrop.
struct Silhouette {
    int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1, area = 0;

    explicit Silhouette(const ScreenPicture& picture, const DisplayValue& backdrop) {
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                if (picture.at(x, y) == backdrop) continue;
                left = std::min(left, x);
                right = std::max(right, x);
                top = std::min(top, y);
                bottom = std::max(bottom, y);
                ++area;
            }
        }
    }
    double x() const { return 0.5 * (left + right + 1); }
    double y() const { return 0.5 * (top + bottom + 1); }
};

TEST_F(WindowMouseTest, DragTurnsTheCamera) {
    show(make_test_asset({}));
    const ScreenPicture before = screen();
    const ViewState start = view();
    drag({200, 150}, {260, 120});
    settle();
    // Half a turn over the height of the window.
    EXPECT_NEAR(view().camera.orbit.azimuth_rad, start.camera.orbit.azimuth_rad - kPi * 60 / 300,
                1e-9);
    EXPECT_NEAR(view().camera.orbit.elevation_rad,
                start.camera.orbit.elevation_rad - kPi * 30 / 300, 1e-9);
    EXPECT_EQ(view().light, start.light);
    EXPECT_FALSE(view().picked);
    EXPECT_GT(largest_difference(screen(), before), 10);
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
}

TEST_F(WindowMouseTest, RightDragMovesTheBodyAndTheWheelBringsItCloser) {
    show(make_test_asset({}));
    const ScreenPicture first = screen();
    const Silhouette before(first, kBackdrop);
    drag({200, 150}, {230, 130}, 3);
    settle();
    const Silhouette moved(screen(), kBackdrop);
    // What lies as far away as the target moves with the pointer; what is nearer moves a little more.
    EXPECT_NEAR(moved.x() - before.x(), 30, 3);
    EXPECT_NEAR(moved.y() - before.y(), -20, 3);
    drag({200, 150}, {170, 170}, 2);
    settle();
    EXPECT_LE(largest_difference(screen(), first), kRounding);

    const auto centre = presenter().pick(view(), 0.5f, 0.5f, 400.0f / 300.0f);
    ASSERT_TRUE(centre);
    const double distance = view().camera.orbit.distance;
    user().turn_wheel(2);
    settle();
    EXPECT_NEAR(view().camera.orbit.distance, 0.81 * distance, 1e-9 * distance);
    const Silhouette grown(screen(), kBackdrop);
    EXPECT_GT(grown.area, 1.4 * before.area);
    EXPECT_EQ(presenter().pick(view(), 0.5f, 0.5f, 400.0f / 300.0f), centre);
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);

    drag({200, 150}, {300, 150}, 3);
    press("f");
    EXPECT_LE(largest_difference(screen(), first), kRounding);
}

TEST_F(WindowMouseTest, CtrlDragTurnsTheLight) {
    show(make_test_asset({}));
    const ScreenPicture before = screen();
    const ViewState start = view();
    user().hold("Control_L", true);
    drag({150, 150}, {250, 150});
    user().hold("Control_L", false);
    settle();
    EXPECT_EQ(view().camera, start.camera);
    EXPECT_NE(view().light, start.light);
    EXPECT_GT(largest_difference(screen(), before), 5);
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
}

TEST_F(WindowMouseTest, PanelsKeepTheMouseToThemselves) {
    show(make_test_asset({}));
    press("Tab");
    const CameraView start = view().camera;
    drag({20, 20}, {300, 40});  // the title of the model
    user().turn_wheel(3);
    drag({20, 20}, {20, 20});
    settle();
    EXPECT_EQ(view().camera, start);
    EXPECT_FALSE(view().picked);
    // A drag that began in the picture goes on over them.
    drag({380, 20}, {20, 20});
    EXPECT_NE(view().camera, start);
}

// 48 poses of a body that goes 0.5 along x from pose to pose, 12 times its own width in all.
Asset make_walk() {
    TestAssetOptions options;
    options.num_poses = 48;
    Asset asset = make_test_asset(options);
    for (int p = 0; p < 48; ++p) {
        RigidTransform root;
        root.translation = Vec3d(0.5 * p, 0.0, 0.0);
        asset.moving().root_motion.push_back(root);
    }
    return asset;
}

TEST_F(WindowMouseTest, CameraFollowsABodyThatTravels) {
    show(make_walk());
    const Silhouette first(screen(), kBackdrop);
    press("End");
    const Silhouette last(screen(), kBackdrop);
    EXPECT_GT(last.x() - first.x(), 150);  // all of its way is in the picture
    press("Home");
    const ScreenPicture before = screen();
    press("t");
    EXPECT_EQ(view().camera.target, CameraTarget::pose);
    EXPECT_LE(largest_difference(screen(), before), 2 * kRounding);  // nothing jumps
    press("f");
    for (int i = 0; i < 47; ++i) {
        press("Right");
        if (i % 8 != 0) continue;
        const Silhouette body(screen(), kBackdrop);
        // The body bends by a tenth of its size, which the path does not follow.
        EXPECT_NEAR(body.x(), 200, 25) << i;
        EXPECT_NEAR(body.y(), 150, 25) << i;
        EXPECT_GT(body.bottom - body.top, 0.6 * 300) << i;
    }
    press("t");
    EXPECT_EQ(view().camera.target, CameraTarget::all);
    press("Home");
    const Silhouette left_behind(screen(), kBackdrop);
    EXPECT_LT(left_behind.area, 100);
}

// Of pixels of a plot's line: whether there are any, and where the highest is, as a share of their
// width.
std::optional<double> peak_of_plot(const ScreenPicture& picture) {
    int left = 1 << 20, right = -1, top = 1 << 20, peak = 0;
    for (int y = picture.height / 2; y < picture.height; ++y) {
        for (int x = picture.width / 2; x < picture.width; ++x) {
            const auto [r, g, b] = picture.at(x, y);
            // ImGuiCol_PlotLines of the dark style: 0.61 of each channel.
            if (std::abs(r - 156) > 3 || std::abs(g - 156) > 3 || std::abs(b - 156) > 3) continue;
            left = std::min(left, x);
            right = std::max(right, x);
            if (y < top) {
                top = y;
                peak = x;
            }
        }
    }
    if (right <= left) return std::nullopt;
    return static_cast<double>(peak - left) / (right - left);
}

TEST_F(WindowMouseTest, ClickPicksAVertexAndShowsItsHistory) {
    show(make_test_asset({}), {"--size", "760x560"});
    for (int i = 0; i < 4; ++i) press("bracketleft");
    // A vertex near the middle of the picture.
    const uint32_t num_vertices = presenter().asset().moving().topology.num_vertices;
    PickedVertex nearest;
    double least = 1e9;
    for (uint32_t v = 0; v < num_vertices; ++v) {
        const auto [x, y] = place_of({0, v});
        const auto hit = presenter().pick(view(), static_cast<float>(x / 760.0),
                                          static_cast<float>(y / 560.0), 760.0f / 560.0f);
        const double distance = std::hypot(x - 420, y - 280);
        if (hit != PickedVertex{0, v} || distance > least) continue;
        nearest = {0, v};
        least = distance;
    }
    ASSERT_LT(least, 80);
    const auto [x, y] = place_of(nearest);
    click(static_cast<int>(x) + 3, static_cast<int>(y) + 2);
    settle();
    EXPECT_EQ(view().picked, nearest);
    press("Tab");
    const ScreenPicture picture = screen();
    const auto is_marked = [&](const ScreenPicture& seen) {
        int num_marked = 0;
        for (int column = static_cast<int>(x) - 12; column < x + 12; ++column) {
            for (int row = static_cast<int>(y) - 12; row < y + 12; ++row) {
                num_marked += seen.at(column, row) == DisplayValue{255, 210, 60} ? 1 : 0;
            }
        }
        return num_marked >= 20;
    };
    EXPECT_TRUE(is_marked(picture));
    LimitErrors errors(presenter().shared_asset());
    VertexHistory history(errors, ErrorOf::transfer, 0, nearest.vertex, view().limits);
    ASSERT_TRUE(history.advance(6));
    const auto values = history.values();
    const auto worst = std::max_element(values.begin(), values.end()) - values.begin();
    const std::optional<double> peak = peak_of_plot(picture);
    ASSERT_TRUE(peak);
    EXPECT_EQ(std::lround(5.0 * *peak), worst);

    click(750, 200);  // next to the body
    settle();
    EXPECT_FALSE(view().picked);
    EXPECT_FALSE(is_marked(screen()));
    EXPECT_FALSE(peak_of_plot(screen()));
}

}  // namespace
}  // namespace paim::player
