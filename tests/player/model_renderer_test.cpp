// What the GPU draws against SvdDecoder and shade() on the CPU, ray cast.
#include "player/render/model_renderer.h"

#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/codec/svd_decoder.h"
#include "paim/mesh/planes.h"
#include "player/gl/check.h"
#include "player/gl/headless_context.h"
#include "player/gl/target.h"
#include "tests/player/ray_cast.h"
#include "tests/player/test_model.h"

namespace paim::player {
namespace {

constexpr int kWidth = 120;
constexpr int kHeight = 80;
const Vec3f kBackground(0.25f, 0.5f, 0.125f);

Frame make_frame(const Model& model, double time, const DecodeLimits& limits = {}) {
    Frame frame;
    frame.time = time;
    frame.limits = limits;
    frame.bounds = pose_bounds(model, time, limits.geometry_components);
    frame.camera = frame_bounds(sequence_bounds(model), float{kWidth} / kHeight);
    return frame;
}

Image draw(ModelRenderer& renderer, const Frame& frame, const LightCoefficients& light) {
    const gl::Target target(kWidth, kHeight);
    target.bind();
    glClearColor(kBackground[0], kBackground[1], kBackground[2], 1.0f);
    glClearDepthf(1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    renderer.draw(frame, light, float{kWidth} / kHeight);
    gl::check_errors("testing");
    return target.read();
}

Image reference(const Model& model, const Frame& frame, const LightCoefficients& light) {
    DecodedPose pose;
    SvdDecoder(model).decode(frame.time, frame.limits, pose);
    return ray_cast(model.topology, from_planes(pose.positions),
                    vertex_radiance(model, frame.time, frame.limits, light), frame.camera, kWidth,
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

class ModelRendererTest : public testing::TestWithParam<gl::Api> {
  protected:
    ModelRendererTest() : context_(gl::make_headless_context(GetParam())) {
        gl::report_driver_messages();
    }
    std::unique_ptr<gl::Context> context_;
};

INSTANTIATE_TEST_SUITE_P(Apis, ModelRendererTest, testing::Values(gl::Api::desktop, gl::Api::es),
                         [](const auto& api) {
                             return api.param == gl::Api::desktop ? "Desktop" : "Es";
                         });

TEST_P(ModelRendererTest, DrawsEveryKindOfModel) {
    // Bands: 1, 9, 16, 25 and 49 coefficients, of which only 16 is a multiple of a texel's four.
    for (const uint32_t bands : {1u, 3u, 4u, 5u, 7u}) {
        for (const uint32_t channels : {1u, 3u}) {
            for (const Precision precision : {Precision::f32, Precision::f16}) {
                TestModelOptions options;
                options.bands = bands;
                options.channels = channels;
                options.precision = precision;
                options.albedo_per_vertex = channels == 3;
                const Model model = make_test_model(options);
                const LightCoefficients light = make_test_light(static_cast<int>(bands));
                ModelRenderer renderer(model, {});
                SCOPED_TRACE(fmt::format("{} bands, {} channels, precision {}", bands, channels,
                                         static_cast<int>(precision)));
                const Frame frame = make_frame(model, 1.0);
                expect_equal(reference(model, frame, light), draw(renderer, frame, light));
            }
        }
    }
}

TEST_P(ModelRendererTest, DrawsFractionalPoses) {
    const Model model = make_test_model({});
    const LightCoefficients light = make_test_light(5);
    ModelRenderer renderer(model, {});
    for (const double time : {0.0, 0.25, 1.5, 2.999, 3.0, 3.9}) {
        SCOPED_TRACE(time);
        const Frame frame = make_frame(model, time);
        expect_equal(reference(model, frame, light), draw(renderer, frame, light));
    }
}

TEST_P(ModelRendererTest, HonoursLimitsOfTheFrame) {
    for (const uint32_t channels : {1u, 3u}) {
        TestModelOptions options;
        options.channels = channels;
        const Model model = make_test_model(options);
        const LightCoefficients light = make_test_light(5);
        ModelRenderer renderer(model, {});
        for (const DecodeLimits& limits :
             {DecodeLimits{0, 0, 5}, DecodeLimits{1, 5, 5}, DecodeLimits{3, 2, 5},
              DecodeLimits{3, 5, 1}, DecodeLimits{3, 5, 3}, DecodeLimits{100, 100, 100}}) {
            SCOPED_TRACE(fmt::format("{} channels, {} {} {}", channels, limits.geometry_components,
                                     limits.transfer_components, limits.bands));
            const Frame frame = make_frame(model, 2.3, limits);
            expect_equal(reference(model, frame, light), draw(renderer, frame, light));
        }
    }
}

TEST_P(ModelRendererTest, UploadsNoMoreThanAsked) {
    TestModelOptions options;
    options.channels = 3;
    const Model model = make_test_model(options);
    const LightCoefficients light = make_test_light(5);
    const DecodeLimits limits{2, 3, 3};
    ModelRenderer renderer(model, limits);
    EXPECT_EQ(renderer.plan().geometry_components, 2u);
    EXPECT_EQ(renderer.plan().transfer_components, 3u);
    EXPECT_EQ(renderer.plan().layout.bands, 3u);
    const Frame frame = make_frame(model, 0.4, limits);
    // What was not uploaded cannot be drawn, whatever the frame's limits.
    Frame more = frame;
    more.limits = {};
    const Image expected = reference(model, frame, light);
    expect_equal(expected, draw(renderer, frame, light));
    expect_equal(expected, draw(renderer, more, light));
}

TEST_P(ModelRendererTest, LightWithFewerBandsIsDarkBeyondThem) {
    const Model model = make_test_model({});
    const LightCoefficients light = make_test_light(2);
    ModelRenderer renderer(model, {});
    const Frame frame = make_frame(model, 1.0);
    expect_equal(reference(model, frame, light), draw(renderer, frame, light));
}

// More components than a row of the weights' texture has texels, and components that wrap from row
// to row of theirs.
TEST_P(ModelRendererTest, DrawsThousandsOfComponents) {
    TestModelOptions options;
    options.num_rings = 3;
    options.bands = 2;
    options.num_poses = 2;
    options.geometry_components = 3000;
    options.transfer_components = 2500;
    Model model = make_test_model(options);
    for (float& weight : model.geometry.weights) weight *= 0.02f;
    for (float& weight : model.transfer.weights) weight *= 0.02f;
    const LightCoefficients light = make_test_light(2);
    ModelRenderer renderer(model, {});
    const Frame frame = make_frame(model, 0.7);
    expect_equal(reference(model, frame, light), draw(renderer, frame, light));
}

TEST_P(ModelRendererTest, DrawsSixtyFourBands) {
    TestModelOptions options;
    options.num_rings = 4;
    options.bands = 64;
    options.transfer_components = 2;
    const Model model = make_test_model(options);
    const LightCoefficients light = make_test_light(64);
    ModelRenderer renderer(model, {});
    const Frame frame = make_frame(model, 0.7);
    expect_equal(reference(model, frame, light), draw(renderer, frame, light));
}

TEST_P(ModelRendererTest, DrawsNothingOfAnEmptyModel) {
    TestModelOptions options;
    Model model = make_test_model(options);
    model.topology = {};
    for (LowRankMatrix* matrix : {&model.geometry, &model.transfer}) {
        matrix->num_points = 0;
        matrix->mean = {};
        matrix->components.assign(matrix->num_components, {});
    }
    ModelRenderer renderer(model, {});
    const Image image = draw(renderer, make_frame(model, 0.0), make_test_light(5));
    for (const Vec3f& pixel : image.pixels) ASSERT_EQ(pixel, kBackground);
}

}  // namespace
}  // namespace paim::player
