// Keys, time, camera, depth and cost: what needs no OpenGL.
#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "player/inspect/cost.h"
#include "player/render/clip_from_local.h"
#include "player/render/depth_range.h"
#include "player/ui/keys.h"
#include "player/view/orbit_camera.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr ViewRange kRange{4, {3, 5, 6, 2}};

void press(int key, bool shift, ViewState& view) {
    const KeyBinding* const binding = find_key(key, shift);
    ASSERT_NE(binding, nullptr);
    ASSERT_NE(binding->change, nullptr);
    binding->change(view, kRange);
}

ViewState start() {
    ViewState view;
    view.limits = {3, 5, 6, 2};
    return view;
}

using Limits = std::array<uint32_t, 4>;

Limits limits_of(const ViewState& view) {
    const DecodeLimits& limits = view.limits;
    return {limits.geometry_components, limits.transfer_components, limits.bands,
            limits.vertex_components};
}

TEST(ViewState, FollowsAnAssetThatGetsMoreComponents) {
    const DecodeLimits all;
    constexpr ViewRange kMore{4, {4, 9, 6, 2}};
    ViewState view = start();
    view.animation.time = 1.5;
    view.tone_curve.exposure_ev = 2.0f;
    follow(view, kRange, kMore, all);
    EXPECT_EQ(limits_of(view), (Limits{4, 9, 6, 2}));
    EXPECT_EQ(view.animation.time, 1.5);
    EXPECT_EQ(view.tone_curve.exposure_ev, 2.0f);

    view = start();  // what was lowered stays
    view.limits.transfer_components = 2;
    follow(view, kRange, kMore, all);
    EXPECT_EQ(limits_of(view), (Limits{4, 2, 6, 2}));

    view = start();  // up to what was asked for, or raised to since
    DecodeLimits wanted;
    wanted.transfer_components = 7;
    wanted.geometry_components = 1;
    follow(view, kRange, kMore, wanted);
    EXPECT_EQ(limits_of(view), (Limits{3, 7, 6, 2}));

    view.animation.time = 4.0;  // another asset, with less of everything
    constexpr ViewRange kLess{2, {1, 0, 3, 0}};
    follow(view, kMore, kLess, wanted);
    EXPECT_EQ(limits_of(view), (Limits{1, 0, 3, 0}));
    EXPECT_EQ(view.animation.time, 2.0);
}

TEST(Keys, ChangeLimitsWithinTheAsset) {
    ViewState view = start();
    press(GLFW_KEY_RIGHT_BRACKET, false, view);
    EXPECT_EQ(view.limits.transfer_components, 5u);
    press(GLFW_KEY_LEFT_BRACKET, false, view);
    EXPECT_EQ(view.limits.transfer_components, 4u);
    for (int i = 0; i < 9; ++i) press(GLFW_KEY_LEFT_BRACKET, false, view);
    EXPECT_EQ(view.limits.transfer_components, 0u);

    press(GLFW_KEY_RIGHT_BRACKET, true, view);
    EXPECT_EQ(view.limits.vertex_components, 2u);
    for (const uint32_t expected : {1u, 0u, 0u}) {
        press(GLFW_KEY_LEFT_BRACKET, true, view);
        EXPECT_EQ(view.limits.vertex_components, expected);
    }
    press(GLFW_KEY_RIGHT_BRACKET, true, view);
    EXPECT_EQ(view.limits.vertex_components, 1u);
    EXPECT_EQ(view.limits.transfer_components, 0u);

    press(GLFW_KEY_APOSTROPHE, false, view);
    EXPECT_EQ(view.limits.geometry_components, 3u);
    press(GLFW_KEY_SEMICOLON, false, view);
    EXPECT_EQ(view.limits.geometry_components, 2u);
    for (int i = 0; i < 9; ++i) press(GLFW_KEY_SEMICOLON, false, view);
    EXPECT_EQ(view.limits.geometry_components, 0u);

    press(GLFW_KEY_B, false, view);
    EXPECT_EQ(view.limits.bands, 6u);
    for (int i = 0; i < 9; ++i) press(GLFW_KEY_B, true, view);
    EXPECT_EQ(view.limits.bands, 1u);
    press(GLFW_KEY_B, false, view);
    EXPECT_EQ(view.limits.bands, 2u);
}

TEST(Keys, StepThroughPosesRoundTheEnds) {
    ViewState view = start();
    view.animation.time = 1.5;
    press(GLFW_KEY_RIGHT, false, view);
    EXPECT_EQ(view.animation.time, 2.0);
    EXPECT_FALSE(view.animation.playing);
    view.animation.time = 1.5;
    press(GLFW_KEY_LEFT, false, view);
    EXPECT_EQ(view.animation.time, 1.0);
    press(GLFW_KEY_LEFT, false, view);
    press(GLFW_KEY_LEFT, false, view);
    EXPECT_EQ(view.animation.time, 3.0);
    press(GLFW_KEY_RIGHT, false, view);
    EXPECT_EQ(view.animation.time, 0.0);
    view.animation.time = 3.7;  // the last pose, held
    press(GLFW_KEY_LEFT, false, view);
    EXPECT_EQ(view.animation.time, 2.0);
    press(GLFW_KEY_END, false, view);
    EXPECT_EQ(view.animation.time, 3.0);
    press(GLFW_KEY_HOME, false, view);
    EXPECT_EQ(view.animation.time, 0.0);
    press(GLFW_KEY_SPACE, false, view);
    EXPECT_TRUE(view.animation.playing);
}

TEST(Keys, ChangeToneLightAndBackground) {
    ViewState view = start();
    press(GLFW_KEY_E, false, view);
    EXPECT_EQ(view.tone_curve.exposure_ev, 0.25f);
    press(GLFW_KEY_E, true, view);
    EXPECT_EQ(view.tone_curve.exposure_ev, 0.0f);
    press(GLFW_KEY_G, true, view);
    EXPECT_EQ(view.tone_curve.gamma, 0.0f);
    press(GLFW_KEY_G, false, view);
    EXPECT_EQ(view.tone_curve.gamma, 1.0f);
    press(GLFW_KEY_G, false, view);
    EXPECT_EQ(view.tone_curve.gamma, 1.2f);
    press(GLFW_KEY_G, true, view);
    press(GLFW_KEY_G, true, view);
    EXPECT_EQ(view.tone_curve.gamma, 0.0f);
    for (int i = 0; i < 99; ++i) press(GLFW_KEY_G, false, view);
    EXPECT_EQ(view.tone_curve.gamma, 5.0f);
    press(GLFW_KEY_PERIOD, false, view);
    EXPECT_EQ(view.light.orientation.yaw_deg, 5.0);
    press(GLFW_KEY_COMMA, false, view);
    press(GLFW_KEY_COMMA, false, view);
    EXPECT_EQ(view.light.orientation.yaw_deg, -5.0);
    press(GLFW_KEY_L, false, view);
    EXPECT_FALSE(view.light.turning);
    press(GLFW_KEY_K, false, view);
    EXPECT_EQ(view.background.kind, Background::Kind::blurred);
    for (const float grey : {0.0f, 0.2f, 1.0f}) {
        press(GLFW_KEY_K, false, view);
        EXPECT_EQ(view.background.kind, Background::Kind::color);
        EXPECT_EQ(view.background.color, Vec3f::Constant(grey));
    }
    press(GLFW_KEY_K, false, view);
    EXPECT_EQ(view.background.kind, Background::Kind::environment);
    press(GLFW_KEY_M, false, view);
    EXPECT_EQ(view.tone_curve.tone_operator, ToneOperator::reinhard);
    for (int i = 0; i < 2; ++i) press(GLFW_KEY_M, false, view);
    EXPECT_EQ(view.tone_curve.tone_operator, ToneOperator::clamp);
}

TEST(Keys, ChangeSpeedAndWhatTheSurfaceShows) {
    ViewState view = start();
    for (const double speed : {2.0, 4.0, 4.0}) {
        press(GLFW_KEY_UP, false, view);
        EXPECT_EQ(view.animation.speed, speed);
    }
    press(GLFW_KEY_R, false, view);
    EXPECT_EQ(view.animation.speed, -4.0);
    press(GLFW_KEY_DOWN, false, view);
    EXPECT_EQ(view.animation.speed, -2.0);

    press(GLFW_KEY_C, true, view);  // the first is coefficient 0; before it comes the last
    EXPECT_EQ(view.surface, SurfaceView::coefficient);
    EXPECT_EQ(view.coefficient, 35u);
    press(GLFW_KEY_C, false, view);
    EXPECT_EQ(view.coefficient, 0u);
    view.surface = SurfaceView::lit;
    for (size_t i = 1; i <= surface_views().size(); ++i) {
        press(GLFW_KEY_V, false, view);
        EXPECT_EQ(view.surface, surface_views()[i % surface_views().size()].view);
    }
    press(GLFW_KEY_V, true, view);
    EXPECT_EQ(view.surface, surface_views().back().view);

    using enum Comparison;
    for (const Comparison comparison : {wipe, side_by_side, none}) {
        press(GLFW_KEY_X, false, view);
        EXPECT_EQ(view.comparison, comparison);
    }
    for (const uint32_t count : {9u, 25u, 100u, 1u}) {
        press(GLFW_KEY_Y, false, view);
        EXPECT_EQ(view.num_instances, count);
    }
}

TEST(Keys, EveryKeyIsItsOwnAndDoesSomething) {
    std::set<std::pair<int, bool>> keys;
    std::set<WindowCommand> commands;
    ViewState middle = start();  // where every key has something to change
    middle.animation.time = 1.5;
    middle.limits = {2, 3, 4, 1};
    middle.tone_curve.gamma = 2.0f;
    const std::string help = keys_help();
    for (const KeyGroup& group : key_groups()) {
        for (const KeyRow& row : group.rows) {
            EXPECT_NE(help.find(row.meaning), std::string::npos);
            EXPECT_FALSE(row.bindings.empty()) << row.keys;
            for (const KeyBinding& binding : row.bindings) {
                EXPECT_TRUE(keys.emplace(binding.glfw_key, binding.shift).second) << row.keys;
                EXPECT_EQ(find_key(binding.glfw_key, binding.shift), &binding);
                ASSERT_NE(binding.change != nullptr, binding.command != WindowCommand::none);
                if (binding.change == nullptr) {
                    EXPECT_TRUE(commands.insert(binding.command).second) << row.keys;
                    continue;
                }
                ViewState view = middle;
                binding.change(view, kRange);
                EXPECT_FALSE(view == middle) << row.keys;
            }
        }
    }
    EXPECT_EQ(commands.size(), static_cast<size_t>(WindowCommand::quit));
}

TEST(Keys, NameTheCommandsOfTheWindow) {
    EXPECT_EQ(find_key(GLFW_KEY_ESCAPE, false)->command, WindowCommand::quit);
    EXPECT_EQ(find_key(GLFW_KEY_S, false)->command, WindowCommand::snapshot_png);
    EXPECT_EQ(find_key(GLFW_KEY_S, true)->command, WindowCommand::snapshot_exr);
    EXPECT_EQ(find_key(GLFW_KEY_F, false)->command, WindowCommand::frame_all);
    EXPECT_EQ(find_key(GLFW_KEY_Q, false), nullptr);
    EXPECT_EQ(find_key(GLFW_KEY_ESCAPE, true), nullptr);
}

TEST(Advance, HoldsTheLastPoseAndStartsOver) {
    ViewState view = start();
    view.light.turning = false;
    view.animation.time = 3.0;
    advance(view, kRange.num_poses, 10.0, 0.05);
    EXPECT_NEAR(view.animation.time, 3.5, 1e-6);
    advance(view, kRange.num_poses, 10.0, 0.1);
    EXPECT_NEAR(view.animation.time, 0.5, 1e-6);
    view.animation.playing = false;
    advance(view, kRange.num_poses, 10.0, 1.0);
    EXPECT_NEAR(view.animation.time, 0.5, 1e-6);
    EXPECT_EQ(view.light.orientation.yaw_deg, 0.0);
    view.light.turning = true;
    advance(view, kRange.num_poses, 10.0, 1.0);
    EXPECT_GT(view.light.orientation.yaw_deg, 0.0);
    advance(view, kRange.num_poses, 10.0, 1e6);
    EXPECT_LE(std::abs(view.light.orientation.yaw_deg), 180.0);
}

Bounds unit_bounds() {
    Bounds bounds;
    bounds.extend(Vec3f(-1.0f, -2.0f, -1.0f));
    bounds.extend(Vec3f(1.0f, 2.0f, 3.0f));
    return bounds;
}

TEST(OrbitCamera, LooksLikeTheCameraThatItIsMadeOf) {
    const Camera expected = frame_bounds(unit_bounds(), 1.5f, -1.0f, 0.7f);
    const OrbitCamera orbit = OrbitCamera::of(expected);
    EXPECT_NEAR(orbit.azimuth_rad, -1.0, 1e-6);
    EXPECT_NEAR(orbit.elevation_rad, 0.7, 1e-6);
    // Floats of a few units, after a handful of operations.
    EXPECT_LT((orbit.camera().eye - expected.eye).norm(), 1e-5f);
    EXPECT_EQ(orbit.camera().target, expected.target);
    const Vec3f moved = orbit.camera(Vec3d(1.0, 2.0, 4.0)).eye - orbit.camera().eye;
    EXPECT_LT((moved - Vec3f(1.0f, 2.0f, 4.0f)).norm(), 1e-5f);
}

TEST(OrbitCamera, MovesWithTheMouse) {
    const OrbitCamera start = OrbitCamera::of(frame_bounds(unit_bounds(), 1.0f, 0.0f, 0.0f));
    OrbitCamera orbit = start;
    const Camera before = orbit.camera();
    orbit.orbit(-0.5, 0.0);  // a quarter turn: the camera goes to +X
    EXPECT_GT(orbit.camera().eye.x() - before.target.x(), 3.0f);
    orbit.orbit(0.0, 9.0);  // stops before the pole
    const Vec3f up = (orbit.camera().eye - before.target).normalized();
    EXPECT_GT(up.y(), 0.99f);
    EXPECT_LT(up.y(), 0.9999f);

    orbit = start;
    orbit.pan(1.0, 0.0);  // by the height of the view, to the right: the target goes left
    const float height =
        2.0f * (before.eye - before.target).norm() * std::tan(0.5f * before.vertical_fov_rad);
    EXPECT_NEAR(before.target.x() - orbit.camera().target.x(), height, 1e-4f);

    orbit = start;
    orbit.zoom(1.0);
    EXPECT_LT((orbit.camera().eye - before.target).norm(), (before.eye - before.target).norm());
    for (int i = 0; i < 1000; ++i) orbit.zoom(20.0);
    EXPECT_GT((orbit.camera().eye - before.target).norm(), 0.0f);
    for (int i = 0; i < 1000; ++i) orbit.zoom(-20.0);
    EXPECT_TRUE(orbit.camera().eye.allFinite());
}

TEST(ClipFromLocal, SeesWhatTheRaysOfTheCameraSee) {
    const float aspect = 1.5f;
    const Camera camera = frame_bounds(unit_bounds(), aspect);
    const glm::mat4 to_clip = clip_from_local(camera, aspect, {0.1f, 100.0f});
    for (const auto& [u, v] : {std::pair{0.5f, 0.5f}, {0.1f, 0.9f}, {0.99f, 0.3f}}) {
        const Vec3f point = camera.eye + 5.0f * camera.ray_direction(u, v, aspect);
        const glm::vec4 clip = to_clip * glm::vec4(point.x(), point.y(), point.z(), 1.0f);
        EXPECT_NEAR(clip.x / clip.w, 2.0f * u - 1.0f, 1e-5f);
        EXPECT_NEAR(clip.y / clip.w, 1.0f - 2.0f * v, 1e-5f);
    }
}

TEST(DepthRange, HoldsTheBounds) {
    const Camera camera = frame_bounds(unit_bounds(), 1.0f, 0.5f, 0.3f);
    const DepthRange range = depth_range(camera, unit_bounds());
    const glm::mat4 to_clip = clip_from_local(camera, 1.0f, range);
    for (int corner = 0; corner < 8; ++corner) {
        const Bounds bounds = unit_bounds();
        const glm::vec4 world((corner & 1) ? bounds.lower.x() : bounds.upper.x(),
                              (corner & 2) ? bounds.lower.y() : bounds.upper.y(),
                              (corner & 4) ? bounds.lower.z() : bounds.upper.z(), 1.0f);
        const glm::vec4 clip = to_clip * world;
        EXPECT_LT(std::abs(clip.z), clip.w);
    }
    // Tight: what is in front of the bounds gets no depths.
    EXPECT_GT(range.near_distance, 0.3f * range.far_distance);
}

TEST(DepthRange, StaysUsableFromInsideBehindAndWithoutBounds) {
    const auto usable = [](const DepthRange& range) {
        return range.near_distance > 0.0f && range.near_distance < range.far_distance &&
               std::isfinite(range.far_distance);
    };
    Camera camera = frame_bounds(unit_bounds(), 1.0f);
    const Vec3f away = camera.eye - camera.target;
    camera.eye = camera.target + 0.01f * away;
    EXPECT_TRUE(usable(depth_range(camera, unit_bounds())));
    camera.eye = camera.target + 2.0f * away;
    camera.target = camera.eye + away;  // looks away
    EXPECT_TRUE(usable(depth_range(camera, unit_bounds())));
    EXPECT_TRUE(usable(depth_range(frame_bounds({}, 1.0f), {})));
    Bounds point;
    point.extend(Vec3f(1.0f, 2.0f, 3.0f));
    EXPECT_TRUE(usable(depth_range(frame_bounds(point, 1.0f), point)));
    Bounds huge;
    huge.extend(Vec3f::Constant(-3e38f));
    huge.extend(Vec3f::Constant(3e38f));
    EXPECT_TRUE(usable(depth_range(frame_bounds(huge, 1.0f), huge)));
}

// 9 clusters of 1 + 6 rows, 25 coefficients of one channel, 5 components over time, 6 poses.
TEST(FrameCost, CountsWhatClustersDo) {
    TestAssetOptions options;
    options.precision = Precision::i16;
    options.component_precisions = {Precision::i16, Precision::i16, Precision::i8};
    options.num_clusters = 9;
    options.cluster_components = 6;
    options.coefficient_precisions = {Precision::i16, Precision::i8};
    const Asset asset = make_test_asset(options);
    const CodedMesh& mesh = asset.moving();
    const uint64_t num_vertices = mesh.topology.num_vertices;
    const Cost all = frame_cost(mesh, {});
    EXPECT_EQ(all.multiply_adds, 3u * 4 + 3u * 7);
    EXPECT_EQ(all.cpu_multiply_adds, 63u * (25 * 5 + 3 * 25));
    EXPECT_EQ(all.bytes, (2 + 2 * 2 + 1) * 3 * num_vertices + 4 * 3 + 3 * 4 * 6    // geometry
                             + (2 + 2 * 2 + 3 * 1) * 25 * 63 + 4 * 25 + 5 * 4 * 6  // bases
                             + (2 + 2 + 5 * 1) * num_vertices + 4 * 63);           // vertices
    const Cost some =
        frame_cost(mesh, {.transfer_components = 2, .bands = 3, .vertex_components = 1});
    EXPECT_EQ(some.multiply_adds, 3u * 4 + 3u * 2);
    EXPECT_EQ(some.cpu_multiply_adds, 63u * (9 * 2 + 3 * 9));
    EXPECT_EQ(some.vertex_components, 1u);
    EXPECT_EQ(some.bytes, (2 + 2 * 2 + 1) * 3 * num_vertices + 4 * 3 + 3 * 4 * 6 +
                              (2 + 2 * 2) * 9 * 63 + 4 * 9 + 2 * 4 * 6 + (2 + 2) * num_vertices +
                              4 * 9 * 2);
}

TEST(FrameCost, CountsWhatTheShaderDoes) {
    TestAssetOptions options;
    options.channels = 3;
    options.precision = Precision::f16;
    const Asset asset = make_test_asset(options);  // 5 bands, 3 + 5 components, 6 poses
    const CodedMesh& mesh = asset.moving();
    const uint64_t num_vertices = mesh.topology.num_vertices;
    const Cost all = frame_cost(mesh, {});
    EXPECT_EQ(all.multiply_adds, 3u * 4 + 75u * 6 + 3u * 25);
    EXPECT_EQ(all.bytes, 4 * 3 * num_vertices + 3 * (2 * 3 * num_vertices + 4 * 6) +
                             4 * 75 * num_vertices + 5 * (2 * 75 * num_vertices + 4 * 6));
    const Cost some = frame_cost(mesh, {1, 2, 3});
    EXPECT_EQ(some.multiply_adds, 3u * 2 + 27u * 3 + 3u * 9);
    EXPECT_EQ(some.bands, 3u);
    EXPECT_EQ(some.bytes, 4 * 3 * num_vertices + 1 * (2 * 3 * num_vertices + 4 * 6) +
                              4 * 27 * num_vertices + 2 * (2 * 27 * num_vertices + 4 * 6));
}

}  // namespace
}  // namespace paim::player
