// Keys, time, camera, depth and cost: what needs no OpenGL.
#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

#include "player/render/clip_from_local.h"
#include "player/inspect/cost.h"
#include "player/render/depth_range.h"
#include "player/ui/keys.h"
#include "player/ui/orbit_camera.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr ViewRange kRange{4, 3, 5, 6, 2};

void press(int key, bool shift, ViewState& view) {
    apply(command_of_key(key, shift), view, kRange);
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
    constexpr ViewRange kMore{4, 4, 9, 6, 2};
    ViewState view = start();
    view.time = 1.5;
    view.tone_curve.exposure_ev = 2.0f;
    follow(view, kRange, kMore, all);
    EXPECT_EQ(limits_of(view), (Limits{4, 9, 6, 2}));
    EXPECT_EQ(view.time, 1.5);
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

    view.time = 4.0;  // another asset, with less of everything
    constexpr ViewRange kLess{2, 1, 0, 3, 0};
    follow(view, kMore, kLess, wanted);
    EXPECT_EQ(limits_of(view), (Limits{1, 0, 3, 0}));
    EXPECT_EQ(view.time, 2.0);
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
    view.time = 1.5;
    press(GLFW_KEY_RIGHT, false, view);
    EXPECT_EQ(view.time, 2.0);
    EXPECT_FALSE(view.playing);
    view.time = 1.5;
    press(GLFW_KEY_LEFT, false, view);
    EXPECT_EQ(view.time, 1.0);
    press(GLFW_KEY_LEFT, false, view);
    press(GLFW_KEY_LEFT, false, view);
    EXPECT_EQ(view.time, 3.0);
    press(GLFW_KEY_RIGHT, false, view);
    EXPECT_EQ(view.time, 0.0);
    view.time = 3.7;  // the last pose, held
    press(GLFW_KEY_LEFT, false, view);
    EXPECT_EQ(view.time, 2.0);
    press(GLFW_KEY_END, false, view);
    EXPECT_EQ(view.time, 3.0);
    press(GLFW_KEY_HOME, false, view);
    EXPECT_EQ(view.time, 0.0);
    press(GLFW_KEY_SPACE, false, view);
    EXPECT_TRUE(view.playing);
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
    EXPECT_EQ(view.env_rotation_deg, 5.0);
    press(GLFW_KEY_COMMA, false, view);
    press(GLFW_KEY_COMMA, false, view);
    EXPECT_EQ(view.env_rotation_deg, -5.0);
    press(GLFW_KEY_L, false, view);
    EXPECT_TRUE(view.turning);
    for (const float grey : {0.0f, 0.2f, 1.0f}) {
        press(GLFW_KEY_K, false, view);
        EXPECT_EQ(view.background.kind, Background::Kind::color);
        EXPECT_EQ(view.background.color, Vec3f::Constant(grey));
    }
    press(GLFW_KEY_K, false, view);
    EXPECT_EQ(view.background.kind, Background::Kind::environment);
    press(GLFW_KEY_H, false, view);
    EXPECT_TRUE(view.show_help);
}

// All that keys may change.
auto state_of(const ViewState& view) {
    return std::tuple(view.time, view.playing, limits_of(view), view.tone_curve.exposure_ev,
                      view.tone_curve.gamma, view.env_rotation_deg, view.turning,
                      view.background.kind, view.show_help, view.show_panel);
}

TEST(Keys, EveryCommandHasAKeyOfItsOwnAndAnEffect) {
    std::set<Command> reached;
    for (const KeyRow& row : key_table()) {
        for (const KeyBinding& binding : {row.first, row.second}) {
            if (binding.command == Command::none) continue;
            EXPECT_EQ(command_of_key(binding.glfw_key, binding.shift), binding.command);
            EXPECT_TRUE(reached.insert(binding.command).second) << row.keys;
        }
        EXPECT_NE(keys_help().find(row.meaning), std::string::npos);
    }
    ViewState middle = start();  // where every command has something to change
    middle.time = 1.5;
    middle.limits = {2, 3, 4, 1};
    middle.tone_curve.gamma = 2.0f;
    for (int j = 1; j <= static_cast<int>(Command::quit); ++j) {
        const auto command = static_cast<Command>(j);
        EXPECT_EQ(reached.count(command), 1u) << j;
        ViewState view = middle;
        apply(command, view, kRange);
        const bool is_of_the_window = command == Command::frame_all ||
                                      command == Command::snapshot || command == Command::quit;
        EXPECT_EQ(state_of(view) == state_of(middle), is_of_the_window) << j;
    }
}

TEST(Keys, NameTheCommandsOfTheWindow) {
    EXPECT_EQ(command_of_key(GLFW_KEY_ESCAPE, false), Command::quit);
    EXPECT_EQ(command_of_key(GLFW_KEY_S, false), Command::snapshot);
    EXPECT_EQ(command_of_key(GLFW_KEY_F, false), Command::frame_all);
    EXPECT_EQ(command_of_key(GLFW_KEY_Q, false), Command::none);
    EXPECT_EQ(command_of_key(GLFW_KEY_S, true), Command::none);
}

TEST(Advance, HoldsTheLastPoseAndStartsOver) {
    ViewState view = start();
    view.time = 3.0;
    advance(view, kRange, 10.0f, 0.05);
    EXPECT_NEAR(view.time, 3.5, 1e-6);
    advance(view, kRange, 10.0f, 0.1);
    EXPECT_NEAR(view.time, 0.5, 1e-6);
    view.playing = false;
    advance(view, kRange, 10.0f, 1.0);
    EXPECT_NEAR(view.time, 0.5, 1e-6);
    EXPECT_EQ(view.env_rotation_deg, 0.0);
    view.turning = true;
    advance(view, kRange, 10.0f, 1.0);
    EXPECT_GT(view.env_rotation_deg, 0.0);
    advance(view, kRange, 10.0f, 1e6);
    EXPECT_LE(std::abs(view.env_rotation_deg), 180.0);
}

Bounds unit_bounds() {
    Bounds bounds;
    bounds.extend(Vec3f(-1.0f, -2.0f, -1.0f));
    bounds.extend(Vec3f(1.0f, 2.0f, 3.0f));
    return bounds;
}

TEST(OrbitCamera, StartsWhereSnapshotsAreTaken) {
    CameraOptions options;
    options.azimuth_rad = -1.0f;
    options.elevation_rad = 0.7f;
    options.distance_factor = 1.5f;
    const Camera expected = start_camera(options, unit_bounds(), 1.5f);
    OrbitCamera orbit;
    orbit.frame(options, unit_bounds(), 1.5f);
    // Floats of a few units, after a handful of operations.
    EXPECT_LT((orbit.camera().eye - expected.eye).norm(), 1e-5f);
    EXPECT_EQ(orbit.camera().target, expected.target);

    const Camera nearer = start_camera({-1.0f, 0.7f, 0.75f}, unit_bounds(), 1.5f);
    EXPECT_NEAR((nearer.eye - nearer.target).norm(), 0.5f * (expected.eye - expected.target).norm(),
                1e-5f);
}

TEST(OrbitCamera, MovesWithTheMouse) {
    OrbitCamera orbit;
    orbit.frame({0.0f, 0.0f, 1.0f}, unit_bounds(), 1.0f);
    const Camera before = orbit.camera();
    orbit.orbit(-0.5f, 0.0f);  // a quarter turn: the camera goes to +X
    EXPECT_GT(orbit.camera().eye.x() - before.target.x(), 3.0f);
    orbit.orbit(0.0f, 9.0f);  // stops before the pole
    const Vec3f up = (orbit.camera().eye - before.target).normalized();
    EXPECT_GT(up.y(), 0.99f);
    EXPECT_LT(up.y(), 0.9999f);

    orbit.frame({0.0f, 0.0f, 1.0f}, unit_bounds(), 1.0f);
    orbit.pan(1.0f, 0.0f);  // by the height of the view, to the right: the target goes left
    const float height =
        2.0f * (before.eye - before.target).norm() * std::tan(0.5f * before.vertical_fov_rad);
    EXPECT_NEAR(before.target.x() - orbit.camera().target.x(), height, 1e-4f);

    orbit.frame({0.0f, 0.0f, 1.0f}, unit_bounds(), 1.0f);
    orbit.zoom(1.0f);
    EXPECT_LT((orbit.camera().eye - before.target).norm(), (before.eye - before.target).norm());
    for (int i = 0; i < 1000; ++i) orbit.zoom(20.0f);
    EXPECT_GT((orbit.camera().eye - before.target).norm(), 0.0f);
    for (int i = 0; i < 1000; ++i) orbit.zoom(-20.0f);
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
