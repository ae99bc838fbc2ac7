// Images on faces: pictures against the reference renderer, and against albedo where both are the same.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/image/texture_pyramids.h"
#include "paim/mesh/planes.h"
#include "paim/render/textured.h"
#include "tests/player/ray_cast.h"
#include "tests/player/surface_pictures.h"
#include "tests/player/textured_asset.h"

namespace paim::player {
namespace {

constexpr int kWidth = 200, kHeight = 150;
constexpr float kAspect = float{kWidth} / kHeight;
constexpr uint32_t kNumRings = 12;

uint16_t first_image(size_t) {
    return 1;
}

// Soft colours that differ from place to place.
Rgb8 soft(uint32_t x, uint32_t y) {
    const auto wave = [](double t) { return static_cast<uint8_t>(128.0 + 100.0 * std::sin(t)); };
    return {wave(0.35 * x), wave(0.3 * y + 1.0), wave(0.2 * x + 0.25 * y)};
}

Asset textured_asset(uint32_t num_clusters, float repeats) {
    TestAssetOptions options;
    options.num_rings = kNumRings;
    options.albedo_per_vertex = true;
    options.num_clusters = num_clusters;
    options.cluster_components = num_clusters > 0 ? 2 : 0;
    Asset asset = make_test_asset(options);
    CodedMesh& mesh = asset.moving();
    const auto stripes = [](uint32_t x, uint32_t) { return Rgb8{soft(x, 0)[0], 200, 90}; };
    mesh.texture = wrap(mesh.topology, kNumRings, repeats,
                        {make_image(90, 61, soft), make_image(32, 8, stripes)},
                        [](size_t f) { return static_cast<uint16_t>(f / 2 % 3); });
    mesh.texture.factors[1] = Vec3f(0.9f, 0.2f, 0.6f);
    return asset;
}

class TextureTest : public SurfacePictures {
  protected:
    static ViewState black_view(double time) {
        ViewState view;
        view.animation.time = time;
        view.background.kind = Background::Kind::color;
        return view;
    }
};

INSTANTIATE_TEST_SUITE_P(Ways, TextureTest, all_ways(),
                         [](const auto& way) { return way.param.name; });

Image reference(Presenter& presenter, const ViewState& view) {
    CodedMesh mesh = presenter.asset().moving();
    const double time = view.animation.time;
    DecodedPose pose;
    MeshDecoder(mesh).decode(time, view.limits, pose);
    move_to_scene(pose.root, pose.positions, pose.num_following);
    const std::vector<Vec3f> positions = from_planes(pose.positions);
    const LightCoefficients light = presenter.light_of(view);
    const Camera camera = presenter.camera(view);
    const VisiblePoints visible = find_visible(mesh.topology, positions, camera, kWidth, kHeight);
    Image image =
        interpolate_image(visible, mesh.topology, vertex_radiance(mesh, time, view.limits, light));
    mesh.albedo.values = {Vec3f::Ones()};
    draw_texture(visible, mesh.topology, positions, camera, mesh.texture,
                 make_pyramids(mesh.texture.images),
                 vertex_radiance(mesh, time, view.limits, light), image);
    return image;
}

// Shares of the body's pixels whose display values differ by more than two steps, as in other
// comparisons with the reference renderer: pixels at edges may show either side of the edge. What
// drivers make of sRGB is near its curve (llvmpipe: to 0.3 %), which is a step at most.
void expect_same(const Image& expected, const Image& drawn, const std::string& what) {
    const auto [covered, off, bright] = compare_shown(expected, drawn);
    EXPECT_GT(covered, expected.pixels.size() / 40) << what;
    EXPECT_LE(bright, covered / 20) << what;  // white hides differences
    EXPECT_LE(static_cast<double>(off), 5e-3 * static_cast<double>(covered)) << what;
}

// Two images and faces without one, enlarged, and made so small that pixels cover many of the images'.
TEST_P(TextureTest, IsDrawnAsByTheReferenceRenderer) {
    for (const uint32_t num_clusters : {0u, 3u}) {
        for (const float repeats : {1.0f, 5.0f}) {
            Presenter presenter = present(textured_asset(num_clusters, repeats));
            EXPECT_EQ(presenter.renderer().decodes_on_cpu(), GetParam().decoder == Decoder::cpu);
            ViewState view = black_view(1.25);
            view.camera.orbit.azimuth_rad = 2.5;
            view.camera.orbit = presenter.framed(view, kAspect, true);
            for (const double zoom : {1.0, 6.0, 0.3}) {
                ViewState shown = view;
                shown.camera.orbit.zoom(zoom);
                expect_same(reference(presenter, shown),
                            presenter.render(shown, kWidth, kHeight, 1),
                            fmt::format("{} {} {}", num_clusters, repeats, zoom));
            }
        }
    }
}

// Where a ring closes, the image ends and begins: nothing of its middle may be seen.
TEST_P(TextureTest, SeamsShowNoOtherPartOfTheImage) {
    Asset asset = textured_asset(0, 1.0f);
    CodedMesh& mesh = asset.moving();
    const auto color = [](uint32_t x, uint32_t) {
        return x >= 20 && x < 44 ? Rgb8{0, 255, 0} : Rgb8{255, 0, 0};
    };
    mesh.texture = wrap(mesh.topology, kNumRings, 1.0f, {make_image(64, 64, color)}, first_image);
    Presenter presenter = present(asset);
    // Rings begin towards +Z; the middle of the image, green, is on the other side.
    ViewState view = black_view(0.0);
    view.camera.orbit.azimuth_rad = 0.0;
    view.camera.orbit.elevation_rad = 0.0;
    view.camera.orbit = presenter.framed(view, kAspect, true);
    view.camera.orbit.zoom(6.0);  // no pole is seen, where pixels cover all of a row
    const Image image = presenter.render(view, kWidth, kHeight, 1);
    size_t num_red = 0, num_green = 0;
    for (const Vec3f& pixel : image.pixels) {
        num_red += pixel.x() > 0.0f && pixel.y() == 0.0f ? 1 : 0;
        num_green += pixel.y() > 0.0f ? 1 : 0;
    }
    EXPECT_GT(num_red, size_t{kWidth} * kHeight / 2);
    EXPECT_EQ(num_green, 0u);
}

// Squares of one pixel, each many times smaller than a pixel of the picture, are grey: half of the
// light. No pixel, and no moment, shows more of one colour than of the other.
TEST_P(TextureTest, FineSquaresFarAwayAreGrey) {
    const auto picture = [&](const std::function<Rgb8(uint32_t, uint32_t)>& color, double time) {
        Asset asset = textured_asset(0, 20.0f);
        CodedMesh& mesh = asset.moving();
        mesh.texture =
            wrap(mesh.topology, kNumRings, 20.0f, {make_image(64, 64, color)}, first_image);
        Presenter presenter = present(asset);
        ViewState view = black_view(time);
        view.camera.orbit = presenter.framed(view, kAspect, false);
        view.camera.orbit.zoom(0.4);
        return presenter.render(view, kWidth, kHeight, 1);
    };
    const auto squares = [](uint32_t x, uint32_t y) {
        const uint8_t value = (x + y) % 2 == 0 ? 255 : 0;
        return Rgb8{value, value, value};
    };
    // 188 of 255 is half of the light (MipPyramid.AveragesLinearLight).
    const auto grey = [](uint32_t, uint32_t) { return Rgb8{188, 188, 188}; };
    for (const double time : {0.0, 0.5}) {
        const Image drawn = picture(squares, time), expected = picture(grey, time);
        size_t num_lit = 0;
        for (size_t i = 0; i < drawn.pixels.size(); ++i) {
            num_lit += expected.pixels[i].isZero(0.0f) ? 0 : 1;
            // The same level and mix of equal values, but for rounding.
            EXPECT_LE((drawn.pixels[i] - expected.pixels[i]).cwiseAbs().maxCoeff(),
                      1e-5f * expected.pixels[i].maxCoeff());
        }
        EXPECT_GT(num_lit, 400u);
    }
}

// A body that travels and turns over a floor, with a still part, once with an albedo and once with a
// white image whose factor is the same colour. The still part has no texture.
struct Pair {
    Asset plain, textured;
};

Pair same_with_image() {
    TestAssetOptions options;
    options.num_rings = kNumRings;
    Pair pair{make_test_asset(options), {}};
    CodedMesh& mesh = pair.plain.moving();
    for (uint32_t p = 0; p < options.num_poses; ++p) {
        mesh.root_motion.push_back({Eigen::Quaterniond(Eigen::AngleAxisd(0.8 * p, Vec3d::UnitY())),
                                    Vec3d(0.3 * p, 0.1 * p, -0.2 * p)});
    }
    mesh.num_following = 2 * kNumRings * (kNumRings - 2);
    pair.plain.parts.push_back(stand_still(pair.plain.moving(), 2.5f));
    pair.textured = pair.plain;
    CodedMesh& textured = pair.textured.moving();
    const auto white = [](uint32_t, uint32_t) { return Rgb8{255, 255, 255}; };
    textured.texture =
        wrap(textured.topology, kNumRings, 3.0f, {make_image(5, 3, white), make_image(1, 1, white)},
             [](size_t f) { return static_cast<uint16_t>(f % 3); });
    textured.texture.factors.assign(2, textured.albedo.values[0]);
    return pair;
}

std::vector<std::pair<std::string, ViewState>> all_views() {
    std::vector<std::pair<std::string, ViewState>> views;
    const auto add = [&](const char* name, const std::function<void(ViewState&)>& change) {
        views.emplace_back(name, ViewState{});
        views.back().second.animation.time = 1.25;
        change(views.back().second);
    };
    add("lit", [](ViewState&) {});
    add("edges", [](ViewState& view) { view.edges = true; });
    add("crowd", [](ViewState& view) { view.num_instances = 9; });
    add("wipe", [](ViewState& view) {
        view.comparison = Comparison::wipe;
        view.limits = {1, 1, 2, 0};
    });
    add("side by side", [](ViewState& view) {
        view.comparison = Comparison::side_by_side;
        view.limits = {1, 1, 2, 0};
    });
    add("key light", [](ViewState& view) { view.light.key_on = true; });
    return views;
}

// Both take the product of colours and light in another order: four roundings of 2^-24 for each of
// them, and as much for interpolation.
TEST_P(TextureTest, AWhiteImageIsAnAlbedoInAllViews) {
    const Pair pair = same_with_image();
    Presenter plain = present(pair.plain), textured = present(pair.textured);
    for (auto& [name, view] : all_views()) {
        view.camera.orbit = plain.framed(view, kAspect, false);
        const Image expected = plain.render(view, kWidth, kHeight, 1);
        const Image drawn = textured.render(view, kWidth, kHeight, 1);
        size_t num_off = 0;
        for (size_t i = 0; i < drawn.pixels.size(); ++i) {
            const Vec3f off = (drawn.pixels[i] - expected.pixels[i]).cwiseAbs();
            num_off += (off.array() <= 1e-5f * (1.0f + expected.pixels[i].array())).all() ? 0 : 1;
        }
        EXPECT_EQ(num_off, 0u) << name;
    }
}

// Other views than the lit one, and --no-textures, show what they show without images.
TEST_P(TextureTest, ColorsOfVerticesAreShownWithoutImages) {
    Asset with = textured_asset(0, 1.0f), without = with;
    without.moving().texture = {};
    Presenter textured = present(with), plain = present(without);
    for (const SurfaceView surface : {SurfaceView::lit, SurfaceView::albedo, SurfaceView::normals,
                                      SurfaceView::coefficient, SurfaceView::transfer_error}) {
        ViewState view = black_view(0.5);
        view.surface = surface;
        view.limits.transfer_components = 2;
        view.camera.orbit = plain.framed(view, kAspect, true);
        view.textures = surface != SurfaceView::lit;
        const Image expected = plain.render(view, kWidth, kHeight, 1);
        EXPECT_EQ(textured.render(view, kWidth, kHeight, 1).pixels, expected.pixels)
            << row_of(surface).name;
        // The images come back, under the light that there was before.
        view.surface = SurfaceView::lit;
        view.textures = true;
        const Image lit = textured.render(view, kWidth, kHeight, 1);
        expect_same(reference(textured, view), lit, std::string(row_of(surface).name));
        EXPECT_GT(compare(expected, lit).fraction_off, 0.1);
    }
}

// A longer beginning of the file has the same images.
TEST_P(TextureTest, AnotherAssetIsDrawnWithItsOwnImages) {
    Presenter presenter = present(textured_asset(0, 1.0f));
    ViewState view = black_view(0.5);
    view.camera.orbit = presenter.framed(view, kAspect, true);
    Asset other = textured_asset(0, 1.0f);
    for (const bool has_other_images : {false, true}) {
        if (has_other_images) {
            std::swap(other.moving().texture.images[0], other.moving().texture.images[1]);
        }
        const auto shared = std::make_shared<const Asset>(other);
        presenter.set_asset(shared, sequence_bounds(*shared), {}, {});
        expect_same(reference(presenter, view), presenter.render(view, kWidth, kHeight, 1),
                    has_other_images ? "other images" : "the same images");
    }
}

TEST_P(TextureTest, DamagedImagesAreRefusedAndTheModelBeforeStays) {
    const Asset whole = textured_asset(0, 1.0f);
    Presenter presenter = present(whole);
    ViewState view = black_view(0.5);
    view.camera.orbit = presenter.framed(view, kAspect, true);
    const Image before = presenter.render(view, kWidth, kHeight, 1);
    Asset damaged = whole;
    damaged.moving().texture.images[1].bytes.resize(40);
    const auto shared = std::make_shared<const Asset>(damaged);
    try {
        presenter.set_asset(shared, sequence_bounds(*shared), {}, {});
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find("made.png"), std::string::npos) << error.what();
    }
    EXPECT_EQ(presenter.render(view, kWidth, kHeight, 1).pixels, before.pixels);
}

}  // namespace
}  // namespace paim::player
