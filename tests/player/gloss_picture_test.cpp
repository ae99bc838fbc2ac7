// Gloss in pictures: at pixels and at vertices, against sums on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "paim/base/seed.h"
#include "paim/codec/playback.h"
#include "paim/codec/svd/svd_transfer.h"
#include "paim/mesh/planes.h"
#include "paim/render/render.h"
#include "paim/sh/basis.h"
#include "player/gl/target.h"
#include "player/render/vertex_source.h"
#include "tests/player/surface_pictures.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr int kWidth = 200, kHeight = 150;
constexpr float kAspect = float{kWidth} / kHeight;
constexpr uint32_t kOutBands = 4;

// Gloss of a sphere around the origin: coefficients that change smoothly from vertex to vertex and
// from pose to pose. Every third face has a vertex without a row.
CodedGloss make_gloss(const CodedMesh& mesh) {
    CodedGloss gloss;
    gloss.layout = {TransferKind::glossy, 4, 1, kOutBands};
    const std::vector<float> positions = mesh.positions.mean_floats();
    const size_t num_vertices = mesh.topology.num_vertices;
    for (uint32_t v = 0; v < num_vertices; ++v) {
        if (v % 7 != 3) gloss.vertices.push_back(v);
    }
    gloss.num_rows = static_cast<uint32_t>(gloss.vertices.size());
    RandomStream random(4);
    LowRank matrix;
    matrix.num_points = gloss.num_rows;
    matrix.num_planes = gloss.layout.num_planes();
    matrix.num_poses = mesh.num_poses();
    matrix.num_components = 1;
    std::vector<float> mean, component;
    for (uint32_t plane = 0; plane < matrix.num_planes; ++plane) {
        // The mean light makes lobes of the last outgoing band, which turn fastest.
        const uint32_t i = plane % gloss.layout.num_coefficients();
        const bool is_lobe = i == 0 && gloss.layout.output_band(plane) + 1 == kOutBands;
        const double strength = plane == 0 ? 2.5
                                : is_lobe  ? 5.0 * (random.uniform() - 0.5)
                                           : 0.1 * (random.uniform() - 0.5);
        const double phase = 6.0 * random.uniform();
        for (const uint32_t v : gloss.vertices) {
            const double height = positions[v] + 0.5 * positions[num_vertices + v];
            mean.push_back(static_cast<float>(strength * (1.0 + 0.5 * std::sin(height + phase))));
            component.push_back(static_cast<float>(0.3 * strength * std::cos(height + phase)));
        }
    }
    matrix.mean = mean;
    matrix.components = {component};
    for (uint32_t p = 0; p < matrix.num_poses; ++p) matrix.weights.push_back(std::sin(1.0f + p));
    matrix.singular_values = {1.0};
    gloss.transfer = SvdTransfer(std::move(matrix));
    gloss.tint.values = {Vec3f(1.0f, 0.8f, 0.6f)};
    return gloss;
}

Asset glossy_asset(bool turned) {
    TestAssetOptions options;
    options.num_rings =
        6;  // triangles so large that the eye is in another direction at each corner
    options.bands = 3;
    Asset asset = make_test_asset(options);
    CodedMesh& mesh = asset.moving();
    mesh.gloss = make_gloss(mesh);
    if (!turned) return asset;
    mesh.root_motion.resize(mesh.num_poses());
    for (size_t p = 0; p < mesh.root_motion.size(); ++p) {
        const double angle = 0.4 + 0.3 * static_cast<double>(p);
        mesh.root_motion[p].rotation = Eigen::AngleAxisd(angle, Vec3d(1, 2, 0.5).normalized());
        mesh.root_motion[p].translation = Vec3d(0.2 * angle, -0.1, 0.3);
    }
    return asset;
}

class GlossPictures : public SurfacePictures {
  protected:
    ViewState view_of(Presenter& presenter, GlossDetail gloss) const {
        ViewState view;
        view.animation.time = 1.25;
        view.background.kind = Background::Kind::color;
        view.camera.orbit.azimuth_rad = 2.5;
        view.camera.orbit = presenter.framed(view, kAspect, true);
        view.camera.orbit.zoom(2.0);
        view.gloss = gloss;
        return view;
    }
};

INSTANTIATE_TEST_SUITE_P(Ways, GlossPictures, all_ways(),
                         [](const auto& way) { return way.param.name; });

// A pose on the CPU, and what is seen of it.
struct Seen {
    Playback playback;
    std::vector<Vec3f> positions;
    VisiblePoints visible;
    Camera camera;

    Seen(Presenter& presenter, const ViewState& view, bool with_eye)
        : playback(std::make_shared<const Asset>(presenter.asset())),
          camera(presenter.camera(view)) {
        playback.set_light(DistantLight(presenter.light_of(view)));
        playback.keep_exit_radiance(true);
        if (with_eye) playback.set_eye(camera.eye);
        playback.update(view.animation.time);
        positions = from_planes(playback.positions());
        visible = find_visible(topology(), positions, camera, kWidth, kHeight);
    }
    const Topology& topology() const { return playback.asset().moving().topology; }
};

// Gloss at each pixel: interpolated coefficients in the direction of the eye.
void add_gloss(const Seen& seen, Image& image) {
    const CodedGloss& gloss = *seen.playback.asset().moving().gloss;
    const std::span<const Vec3f> exit = seen.playback.exit_radiance();
    std::vector<int64_t> row_of(seen.topology().num_vertices, -1);
    for (uint32_t r = 0; r < gloss.num_rows; ++r) row_of[gloss.vertex(r)] = r;
    std::vector<float> basis(size_t{kOutBands} * kOutBands);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Hit& hit = seen.visible.hits[i];
        if (hit.triangle == kNoTriangle) continue;
        const Triangle& corners = seen.topology().triangles[hit.triangle];
        const float shares[3] = {1.0f - hit.u - hit.v, hit.u, hit.v};
        Vec3f place = Vec3f::Zero();
        for (size_t k = 0; k < 3; ++k) place += shares[k] * seen.positions[corners[k]];
        const Vec3d towards = (seen.camera.eye - place).cast<double>();
        const Vec3d local = seen.playback.root().rotation.conjugate() * towards;
        sh::evaluate_basis(static_cast<int>(kOutBands), local, std::span(basis));
        for (size_t k = 0; k < 3; ++k) {
            const int64_t row = row_of[corners[k]];
            for (size_t o = 0; o < basis.size() && row >= 0; ++o) {
                image.pixels[i] +=
                    shares[k] * basis[o] * exit[o * gloss.num_rows + static_cast<size_t>(row)];
            }
        }
    }
}

// The share of the body's pixels whose display values differ by more than two steps: pixels at edges
// may show either side of the edge.
double share_off(const Image& expected, const Image& drawn) {
    const ShownPixels pixels = compare_shown(expected, drawn);
    EXPECT_GT(pixels.covered, expected.pixels.size() / 40);
    return static_cast<double>(pixels.off) / static_cast<double>(pixels.covered);
}

TEST_P(GlossPictures, AtPixelsAndVerticesAreThoseOfTheCpu) {
    for (const bool turned : {false, true}) {
        Presenter presenter = present(glossy_asset(turned));
        ViewState view = view_of(presenter, GlossDetail::pixel);
        const Image at_pixels = presenter.render(view, kWidth, kHeight, 1);
        view.gloss = GlossDetail::vertex;
        const Image at_vertices = presenter.render(view, kWidth, kHeight, 1);
        view.gloss = GlossDetail::none;
        const Image without = presenter.render(view, kWidth, kHeight, 1);

        const Seen diffuse(presenter, view, false), glossy(presenter, view, true);
        const Image matte =
            interpolate_image(diffuse.visible, diffuse.topology(), diffuse.playback.radiance());
        Image by_pixel = matte;
        add_gloss(diffuse, by_pixel);
        const Image by_vertex =
            interpolate_image(glossy.visible, glossy.topology(), glossy.playback.radiance());
        EXPECT_LE(share_off(matte, without), 5e-3);
        EXPECT_LE(share_off(by_vertex, at_vertices), 5e-3);
        EXPECT_LE(share_off(by_pixel, at_pixels), 5e-3);
        // They are three different pictures.
        EXPECT_GT(share_off(matte, at_vertices), 0.2);
        EXPECT_GT(share_off(by_vertex, at_pixels), 0.05);
    }
}

// Views in colours that mean something have no gloss.
TEST_P(GlossPictures, AreOfLitSurfacesAlone) {
    Presenter presenter = present(glossy_asset(false));
    ViewState view = view_of(presenter, GlossDetail::pixel);
    view.surface = SurfaceView::normals;
    const Image with = presenter.render(view, kWidth, kHeight, 1);
    view.gloss = GlossDetail::none;
    EXPECT_EQ(with.pixels, presenter.render(view, kWidth, kHeight, 1).pixels);
}

// Where no gloss is shown none is computed, and what has changed meanwhile is made up for.
TEST_P(GlossPictures, GlossThatIsNotShownIsNotComputed) {
    const auto asset = std::make_shared<const Asset>(glossy_asset(true));
    const gl::Target target(8, 8);  // shaders that write vertices need one
    target.bind();
    const DecodeLimits all;
    std::string note;
    const auto source = make_vertex_source(asset, all, all, GetParam().decoder, note);
    std::vector<SurfaceMesh> parts;
    parts.emplace_back(asset->moving());
    LightCoefficients light{3, std::vector<Vec3f>(9, Vec3f::Ones())};
    const auto num_glosses = [&](double time, bool gloss) {
        source->update(time, source->most(), &light, gloss, parts);
        return parts[0].writes().gloss;
    };
    EXPECT_EQ(num_glosses(0.0, false), 0u);
    EXPECT_EQ(num_glosses(1.0, false), 0u);
    EXPECT_EQ(parts[0].writes().radiance, 2u);
    EXPECT_EQ(num_glosses(1.0, true), 1u);
    EXPECT_EQ(num_glosses(1.0, false), 1u);
    EXPECT_EQ(num_glosses(1.0, true), 1u);  // nothing has changed
    EXPECT_EQ(parts[0].writes().radiance, 2u);
    light.values[0] *= 2.0f;
    EXPECT_EQ(num_glosses(1.0, false), 1u);
    EXPECT_EQ(num_glosses(1.0, true), 2u);
    EXPECT_EQ(parts[0].writes().radiance, 3u);
}

TEST_P(GlossPictures, GlossThatIsShownAgainIsUpToDate) {
    Presenter presenter = present(glossy_asset(true));
    ViewState view = view_of(presenter, GlossDetail::pixel);
    const Image before = presenter.render(view, kWidth, kHeight, 1);
    view.gloss = GlossDetail::none;
    view.animation.time = 0.5;
    presenter.render(view, kWidth, kHeight, 1);
    view.gloss = GlossDetail::pixel;
    const Image again = presenter.render(view, kWidth, kHeight, 1);
    Presenter other = present(glossy_asset(true));
    EXPECT_EQ(again.pixels, other.render(view, kWidth, kHeight, 1).pixels);
    EXPECT_NE(again.pixels, before.pixels);
}

}  // namespace
}  // namespace paim::player
