// What the GPU draws against the decoder and shade() on the CPU, ray cast.
#include "player/render/shader_mesh.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/mesh/planes.h"
#include "player/gl/check.h"
#include "player/gl/headless_context.h"
#include "player/gl/target.h"
#include "player/render/surface_renderer.h"
#include "tests/player/ray_cast.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 80;
const Vec3f kBackground(0.25f, 0.5f, 0.125f);

Frame make_frame(const Asset& asset, double time, const DecodeLimits& limits = {}) {
    Frame frame;
    frame.time = time;
    frame.limits = limits;
    frame.bounds = pose_bounds(asset, time, limits.geometry_components);
    frame.camera = frame_bounds(sequence_bounds(asset), float{kWidth} / kHeight);
    return frame;
}

// A mesh that shaders decode, and its surface.
class MeshRenderer {
  public:
    MeshRenderer(const CodedMesh& mesh, const DecodeLimits& limits)
        : mesh_(mesh), decoder_(mesh, limits), surface_(mesh.topology) {}

    const UploadPlan& plan() const { return decoder_.plan(); }
    uint64_t texture_bytes() const { return decoder_.texture_bytes(); }

    void draw(const Frame& frame, const LightCoefficients& light, float aspect) {
        decoder_.decode(frame.time, frame.limits, surface_.positions());
        decoder_.light(frame.time, frame.limits, light, surface_.lit());
        const Topology& topology = mesh_.topology;
        const SurfacePlace place{topology.num_triangles_before(mesh_.num_following),
                                 root_at(mesh_.root_motion, frame.time)};
        renderer_.draw(surface_, topology.triangles.size(), place, frame, aspect);
    }

  private:
    const CodedMesh& mesh_;
    ShaderMesh decoder_;
    SurfaceMesh surface_;
    SurfaceRenderer renderer_;
};

Image draw(MeshRenderer& renderer, const Frame& frame, const LightCoefficients& light) {
    const gl::Target target(kWidth, kHeight);
    target.bind();
    glClearColor(kBackground[0], kBackground[1], kBackground[2], 1.0f);
    glClearDepthf(1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    renderer.draw(frame, light, float{kWidth} / kHeight);
    gl::check_errors("testing");
    return target.read();
}

Image reference(const Asset& asset, const Frame& frame, const LightCoefficients& light) {
    DecodedPose pose;
    const CodedMesh& mesh = asset.moving();
    MeshDecoder(mesh).decode(frame.time, frame.limits, pose);
    move_to_scene(pose.root, pose.positions, pose.num_following);
    return ray_cast(mesh.topology, from_planes(pose.positions),
                    vertex_radiance(mesh, frame.time, frame.limits, light), frame.camera, kWidth,
                    kHeight, kBackground);
}

// Rasterisers put vertices on a grid of at least 1/16 (llvmpipe: 1/256) of a pixel, so that pixels
// whose centre is that close to an edge may fall on its other side: of the silhouette, about 300
// pixels long, 300/256 pixels or 0.01 % of the picture. Float sums of a few dozen terms differ by
// 1e-6. The limits are those the player promises.
void expect_equal(const Image& expected, const Image& image) {
    const Difference difference = compare(expected, image);
    EXPECT_LE(difference.mean_relative, 1e-3);
    EXPECT_LE(difference.fraction_off, 0.005);
}

// Pictures of these times, in poses, are those of the reference.
void expect_drawn_at(std::initializer_list<double> times, const Asset& asset) {
    const LightCoefficients light = make_test_light(5);
    MeshRenderer renderer(asset.moving(), {});
    for (const double time : times) {
        SCOPED_TRACE(time);
        const Frame frame = make_frame(asset, time);
        expect_equal(reference(asset, frame, light), draw(renderer, frame, light));
    }
}

class ShaderMeshTest : public testing::TestWithParam<gl::Api> {
  protected:
    ShaderMeshTest() : context_(gl::make_headless_context(GetParam())) {
        gl::report_driver_messages();
    }
    std::unique_ptr<gl::Context> context_;
};

INSTANTIATE_TEST_SUITE_P(Apis, ShaderMeshTest, testing::Values(gl::Api::desktop, gl::Api::es),
                         [](const auto& api) {
                             return api.param == gl::Api::desktop ? "Desktop" : "Es";
                         });

TEST_P(ShaderMeshTest, DrawsEveryKindOfMesh) {
    // Bands: 1, 9, 16, 25 and 49 coefficients, of which only 16 is a multiple of a texel's four.
    for (const uint32_t bands : {1u, 3u, 4u, 5u, 7u}) {
        for (const uint32_t channels : {1u, 3u}) {
            for (const Precision precision : {Precision::f32, Precision::f16}) {
                TestAssetOptions options;
                options.bands = bands;
                options.channels = channels;
                options.precision = precision;
                options.albedo_per_vertex = channels == 3;
                const Asset asset = make_test_asset(options);
                const LightCoefficients light = make_test_light(static_cast<int>(bands));
                MeshRenderer renderer(asset.moving(), {});
                SCOPED_TRACE(fmt::format("{} bands, {} channels, precision {}", bands, channels,
                                         static_cast<int>(precision)));
                const Frame frame = make_frame(asset, 1.0);
                expect_equal(reference(asset, frame, light), draw(renderer, frame, light));
            }
        }
    }
}

// Every way that values are stored.
struct Variant {
    const char* name;
    TestAssetOptions options;
};

std::vector<Variant> make_variants() {
    using enum Precision;
    std::vector<Variant> variants;
    for (const uint32_t channels : {1u, 3u}) {
        const auto add = [&](const char* name, Precision precision,
                             std::vector<Precision> components, uint32_t num_clusters = 0,
                             uint32_t cluster_components = 0,
                             std::vector<Precision> coefficients = {}) {
            TestAssetOptions options;
            options.num_rings = 5;
            options.channels = channels;
            options.albedo_per_vertex = channels == 3;
            options.precision = precision;
            options.component_precisions = std::move(components);
            options.num_clusters = num_clusters;
            options.cluster_components = cluster_components;
            options.coefficient_precisions = std::move(coefficients);
            variants.push_back({name, options});
        };
        add("f32", f32, {});
        add("f16", f16, {});
        add("i16", i16, {});
        add("i8", i8, {});
        add("i16, then i8", i16, {i16, i16, i8});
        add("i16 between i8", i16, {i8, i16, i8});
        add("i8 under a mean of i16", i16, {i8});
        add("floats, then integers", i16, {f32, i16, i8});
        add("clusters of floats", f32, {}, 7, 5);
        add("clusters of half floats, i8 coefficients", f16, {}, 7, 8, {i8});
        add("clusters of i16, i16 coefficients", i16, {}, 7, 6, {i16});
        add("clusters of i16 and i8, i8 coefficients", i16, {i16, i8}, 7, 3, {i8});
        add("clusters, i16 coefficients, then i8", i8, {}, 5, 10, {i16, i16, i16, i16, i16, i8});
        add("clusters, floats among i8 coefficients", i8, {}, 5, 6, {i8, f32, i8});
        add("clusters without components", i16, {i8}, 9, 0);
        add("one cluster", i16, {}, 1, 4, {i8});
    }
    return variants;
}

TEST_P(ShaderMeshTest, DrawsEveryWayThatValuesAreStored) {
    for (const auto& [name, options] : make_variants()) {
        SCOPED_TRACE(fmt::format("{}, {} channels", name, options.channels));
        const Asset asset = make_test_asset(options);
        const LightCoefficients light = make_test_light(5);
        MeshRenderer renderer(asset.moving(), {});
        for (const DecodeLimits& limits : {DecodeLimits{}, DecodeLimits{1, 2, 3, 2},
                                           DecodeLimits{2, 4, 5, 5}, DecodeLimits{0, 0, 2, 0}}) {
            const Frame frame = make_frame(asset, 2.3, limits);
            expect_equal(reference(asset, frame, light), draw(renderer, frame, light));
        }
        const DecodeLimits fewer{2, 3, 3, 3};
        MeshRenderer limited(asset.moving(), fewer);
        const Frame frame = make_frame(asset, 0.4, fewer);
        Frame more = frame;  // but it was not uploaded
        more.limits = {};
        const Image expected = reference(asset, frame, light);
        expect_equal(expected, draw(limited, frame, light));
        expect_equal(expected, draw(limited, more, light));
    }
}

// A frame at random is the frame in sequence, bit for bit: nothing is left of other poses, lights
// and limits.
TEST_P(ShaderMeshTest, DrawsTheSameBitsInAnyOrderOfFrames) {
    for (const auto& [name, options] : make_variants()) {
        if (options.channels == 1) continue;  // the others draw all that these do, three times
        SCOPED_TRACE(name);
        const Asset asset = make_test_asset(options);
        const LightCoefficients light = make_test_light(5);
        MeshRenderer sequence(asset.moving(), {}), random(asset.moving(), {});
        std::vector<Image> images;
        for (const double time : {0.0, 1.0, 1.5, 2.0, 5.0}) {
            images.push_back(draw(sequence, make_frame(asset, time), light));
        }
        draw(random, make_frame(asset, 3.0, {1, 1, 2, 1}), make_test_light(2));
        const Frame frame = make_frame(asset, 1.5);
        EXPECT_EQ(draw(random, frame, light).pixels, images[2].pixels);
        draw(random, make_frame(asset, 5.0), light);
        EXPECT_EQ(draw(random, frame, light).pixels, images[2].pixels);
        EXPECT_NE(images[1].pixels, images[2].pixels);
    }
}

// Texels of four values: 8 bytes of i16 or f16, 4 of i8, 16 of f32. Each texture has one at least.
TEST_P(ShaderMeshTest, UploadsIntegersAsTheyAre) {
    using enum Precision;
    TestAssetOptions options;  // 5 bands: 7 texels a vertex; 3 + 5 components
    const uint64_t num_vertices = make_test_asset(options).moving().topology.num_vertices;
    const uint64_t light = 16 * 3 * 7, albedo = 16;
    const auto bytes = [&](uint64_t geometry_mean, uint64_t geometry_int16, uint64_t geometry_int8,
                           uint64_t transfer) {
        const auto at_least = [&](uint64_t texel, uint64_t count) {
            return std::max(texel, texel * count * num_vertices);
        };
        return at_least(geometry_mean, 1) + at_least(8, geometry_int16) +
               at_least(4, geometry_int8) + 4 * 3 + albedo + transfer;
    };
    options.precision = i16;
    EXPECT_EQ(MeshRenderer(make_test_asset(options).moving(), {}).texture_bytes(),
              bytes(8, 3, 0, light + 4 * 5 + 8 * 7 * (1 + 5) * num_vertices + 4));
    options.component_precisions = {i16, i8};
    EXPECT_EQ(MeshRenderer(make_test_asset(options).moving(), {}).texture_bytes(),
              bytes(8, 1, 2, light + 4 * 5 + (8 * 7 * 2 + 4 * 7 * 4) * num_vertices));
    options.precision = i8;
    options.component_precisions = {};
    EXPECT_EQ(MeshRenderer(make_test_asset(options).moving(), {}).texture_bytes(),
              bytes(4, 0, 3, light + 4 * 5 + 8 + 4 * 7 * (1 + 5) * num_vertices));
    // Clusters: an index, coefficients of 6 components in 2 texels, light products of a mean and
    // 2 texels for each colour. No plane of transfer.
    options.num_clusters = 9;
    options.cluster_components = 6;
    options.coefficient_precisions = {i16, i8};
    EXPECT_EQ(MeshRenderer(make_test_asset(options).moving(), {}).texture_bytes(),
              bytes(4, 0, 3, (2 + 8 + 4) * num_vertices + 16 * 9 * (1 + 2 * 3)));
}

TEST_P(ShaderMeshTest, DrawsFractionalPoses) {
    const Asset asset = make_test_asset({});
    expect_drawn_at({0.0, 0.25, 1.5, 2.999, 3.0, 3.9}, asset);
}

TEST_P(ShaderMeshTest, MovesAndTurnsBodies) {
    for (const uint32_t num_clusters : {0u, 3u}) {
        TestAssetOptions options;
        options.num_clusters = num_clusters;
        options.cluster_components = 2;
        Asset asset = make_test_asset(options);
        RootMotion& motion = asset.moving().root_motion;
        motion.resize(asset.num_poses());
        for (uint32_t p = 0; p < asset.num_poses(); ++p) {
            motion[p] = {rotation_of(p * Vec3d(0.3, 0.8, -0.2)), p * Vec3d(0.2, -0.1, 0.4)};
        }
        expect_drawn_at({0.0, 1.0, 2.5, 5.0}, asset);
    }
}

// The upper rings of the sphere move, the lower ones are a floor.
TEST_P(ShaderMeshTest, LeavesAFloorInItsPlace) {
    for (const uint32_t num_clusters : {0u, 3u}) {
        TestAssetOptions options;
        options.num_clusters = num_clusters;
        options.cluster_components = 2;
        Asset asset = make_test_asset(options);
        CodedMesh& mesh = asset.moving();
        mesh.num_following = 5 * 2 * options.num_rings;
        std::erase_if(mesh.topology.triangles, [&](const Triangle& t) {
            const auto follows = [&](uint32_t v) { return v < mesh.num_following; };
            return follows(std::ranges::min(t)) != follows(std::ranges::max(t));
        });
        mesh.root_motion.resize(asset.num_poses());
        for (uint32_t p = 1; p < asset.num_poses(); ++p) {
            mesh.root_motion[p] = {rotation_of(p * Vec3d(0.3, 0.8, -0.2)),
                                   p * Vec3d(0.2, 0.1, 0.1)};
        }
        expect_drawn_at({0.0, 1.0, 2.5, 5.0}, asset);
    }
}

// Far away, a camera that goes along sees what one on the spot sees.
TEST_P(ShaderMeshTest, DoesNotShakeFarFromTheOrigin) {
    Asset asset = make_test_asset({});
    const LightCoefficients light = make_test_light(5);
    Frame frame = make_frame(asset, 0.0);
    // Floats near 2^20 are multiples of 1/8. The cameras are on such places.
    const auto rounded = [](const Vec3f& v) { return Vec3f((8.0f * v).array().round() / 8.0f); };
    frame.camera.eye = rounded(frame.camera.eye);
    frame.camera.target = rounded(frame.camera.target);
    MeshRenderer on_the_spot(asset.moving(), {});
    const Image expected = draw(on_the_spot, frame, light);
    const Vec3f offset(0x1p20f, 0.0f, -0x1p20f);
    asset.moving().root_motion.resize(asset.num_poses());
    for (RigidTransform& root : asset.moving().root_motion) {
        root.translation = offset.cast<double>();
    }
    frame.camera.eye += offset;
    frame.camera.target += offset;
    frame.bounds = pose_bounds(asset, 0.0, 3);
    MeshRenderer far_away(asset.moving(), {});
    expect_equal(expected, draw(far_away, frame, light));
}

TEST_P(ShaderMeshTest, HonoursLimitsOfTheFrame) {
    for (const uint32_t channels : {1u, 3u}) {
        TestAssetOptions options;
        options.channels = channels;
        const Asset asset = make_test_asset(options);
        const LightCoefficients light = make_test_light(5);
        MeshRenderer renderer(asset.moving(), {});
        for (const DecodeLimits& limits :
             {DecodeLimits{0, 0, 5}, DecodeLimits{1, 5, 5}, DecodeLimits{3, 2, 5},
              DecodeLimits{3, 5, 1}, DecodeLimits{3, 5, 3}, DecodeLimits{100, 100, 100}}) {
            SCOPED_TRACE(fmt::format("{} channels, {} {} {}", channels, limits.geometry_components,
                                     limits.transfer_components, limits.bands));
            const Frame frame = make_frame(asset, 2.3, limits);
            expect_equal(reference(asset, frame, light), draw(renderer, frame, light));
        }
    }
}

TEST_P(ShaderMeshTest, UploadsNoMoreThanAsked) {
    TestAssetOptions options;
    options.channels = 3;
    const Asset asset = make_test_asset(options);
    const LightCoefficients light = make_test_light(5);
    const DecodeLimits limits{2, 3, 3};
    MeshRenderer renderer(asset.moving(), limits);
    EXPECT_EQ(renderer.plan().geometry_components, 2u);
    EXPECT_EQ(renderer.plan().transfer_components, 3u);
    EXPECT_EQ(renderer.plan().layout.in_bands, 3u);
    const Frame frame = make_frame(asset, 0.4, limits);
    // What was not uploaded cannot be drawn, whatever the frame's limits.
    Frame more = frame;
    more.limits = {};
    const Image expected = reference(asset, frame, light);
    expect_equal(expected, draw(renderer, frame, light));
    expect_equal(expected, draw(renderer, more, light));
}

TEST_P(ShaderMeshTest, LightWithFewerBandsIsDarkBeyondThem) {
    const Asset asset = make_test_asset({});
    const LightCoefficients light = make_test_light(2);
    MeshRenderer renderer(asset.moving(), {});
    const Frame frame = make_frame(asset, 1.0);
    expect_equal(reference(asset, frame, light), draw(renderer, frame, light));
}

// More components than a row of the weights' texture has texels, and components that wrap from row
// to row of theirs.
TEST_P(ShaderMeshTest, DrawsThousandsOfComponents) {
    TestAssetOptions options;
    options.num_rings = 3;
    options.bands = 2;
    options.num_poses = 2;
    options.geometry_components = 3000;
    options.transfer_components = 2500;
    Asset asset = make_test_asset(options);
    CodedMesh& mesh = asset.moving();
    for (float& weight : mesh.positions.weights) weight *= 0.02f;
    for (float& weight : mesh.transfer->matrix.weights) weight *= 0.02f;
    const LightCoefficients light = make_test_light(2);
    MeshRenderer renderer(asset.moving(), {});
    const Frame frame = make_frame(asset, 0.7);
    expect_equal(reference(asset, frame, light), draw(renderer, frame, light));
}

TEST_P(ShaderMeshTest, DrawsSixtyFourBands) {
    TestAssetOptions options;
    options.num_rings = 4;
    options.bands = 64;
    options.transfer_components = 2;
    const Asset asset = make_test_asset(options);
    const LightCoefficients light = make_test_light(64);
    MeshRenderer renderer(asset.moving(), {});
    const Frame frame = make_frame(asset, 0.7);
    expect_equal(reference(asset, frame, light), draw(renderer, frame, light));
}

TEST_P(ShaderMeshTest, DrawsNothingOfAnEmptyMesh) {
    TestAssetOptions options;
    Asset asset = make_test_asset(options);
    CodedMesh& mesh = asset.moving();
    mesh.topology = {};
    for (LowRank* matrix : {&mesh.positions, &mesh.transfer->matrix}) {
        matrix->num_points = 0;
        matrix->mean = {};
        matrix->components.assign(matrix->num_components, {});
    }
    MeshRenderer renderer(asset.moving(), {});
    const Image image = draw(renderer, make_frame(asset, 0.0), make_test_light(5));
    for (const Vec3f& pixel : image.pixels) ASSERT_EQ(pixel, kBackground);
}

}  // namespace
}  // namespace paim::player
