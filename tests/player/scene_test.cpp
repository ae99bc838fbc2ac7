// Background, light and tone curve on the GPU against the library on the CPU.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "paim/base/error.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/codec/svd/svd_transfer.h"
#include "paim/light/environment.h"
#include "paim/mesh/planes.h"
#include "paim/shade/shade.h"
#include "player/gl/check.h"
#include "player/gl/headless_context.h"
#include "player/render/scene_renderer.h"
#include "player/render/tone_mapper.h"
#include "tests/player/ray_cast.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr int kWidth = 90;
constexpr int kHeight = 60;
constexpr float kAspect = float{kWidth} / kHeight;

// Smooth in both directions and across the seam, no two places alike, up to about 2.
Image make_environment() {
    Image image(64, 32);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double u = 2.0 * kPi * (x + 0.5) / image.width, v = (y + 0.5) / image.height;
            image.at(x, y) = Vec3d(1.0 + std::sin(u) * std::sin(kPi * v), 0.1 + v,
                                   1.0 + std::cos(u) * std::sin(kPi * v))
                                 .cast<float>();
        }
    }
    return image;
}

Asset make_empty_asset() {
    Asset asset = make_test_asset({});
    asset.moving().topology.triangles.clear();
    return asset;
}

struct Way {
    const char* name;
    gl::Api api;
    Decoder decoder;
};

class SceneTest : public testing::TestWithParam<Way> {
  protected:
    SceneTest() : context_(gl::make_headless_context(GetParam().api)) {
        gl::report_driver_messages();
    }
    SceneRenderer make_renderer(const Asset& asset, const EnvironmentLight& environment) const {
        SceneRenderer renderer(std::make_shared<const Asset>(asset), {}, {}, GetParam().decoder);
        renderer.set_environment(environment);
        return renderer;
    }
    std::unique_ptr<gl::Context> context_;
};

INSTANTIATE_TEST_SUITE_P(Ways, SceneTest,
                         testing::Values(Way{"Desktop", gl::Api::desktop, Decoder::gpu},
                                         Way{"Es", gl::Api::es, Decoder::gpu},
                                         Way{"Cpu", gl::Api::desktop, Decoder::cpu}),
                         [](const auto& way) { return way.param.name; });

// Every pixel's direction, turned back by the light's angle and looked up on the CPU. Shaders may
// compute atan to 4096 ulp (GLSL 4.1 and later; llvmpipe's is near 1e-6), and single precision
// moves the place in the map by 1e-5 of it: 1e-4 pixels of 64, over which this map changes by 0.1 a
// pixel.
TEST_P(SceneTest, BackgroundIsTheTurnedEnvironment) {
    const Asset asset = make_empty_asset();
    const EnvironmentLight environment(make_environment());
    SceneRenderer renderer = make_renderer(asset, environment);
    struct View {
        Vec3f eye;
        double rotation_rad;
    };
    // Level, across the seam (which lies at -Z), nearly up and nearly down; turned both ways.
    for (const View& view : {View{{1.0f, 0.2f, 0.3f}, 0.0}, View{{0.0f, 0.0f, 1.0f}, 0.0},
                             View{{0.1f, -2.0f, 0.05f}, 0.4}, View{{0.1f, 2.0f, -0.05f}, -2.5},
                             View{{-1.0f, 0.0f, 0.2f}, 9.0}}) {
        Frame frame;
        frame.camera.eye = view.eye;
        frame.camera.vertical_fov_rad = 1.2f;
        light_frame(frame, environment, 5, view.rotation_rad);
        const Image image = renderer.render(frame, kWidth, kHeight, 1);
        const Eigen::AngleAxisd turn_back(-view.rotation_rad, Vec3d::UnitY());
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const Vec3d direction =
                    frame.camera
                        .ray_direction((static_cast<float>(x) + 0.5f) / kWidth,
                                       (static_cast<float>(y) + 0.5f) / kHeight, kAspect)
                        .cast<double>();
                const Vec3f expected = environment.radiance(turn_back * direction);
                ASSERT_LT((image.at(x, y) - expected).cwiseAbs().maxCoeff(), 1e-4f)
                    << x << ", " << y;
            }
        }
    }
}

TEST_P(SceneTest, LightTurnsWithTheBackground) {
    const Asset asset = make_test_asset({});
    const EnvironmentLight environment(make_environment());
    SceneRenderer renderer = make_renderer(asset, environment);
    Frame frame;
    frame.time = 1.25;
    frame.bounds = pose_bounds(asset, frame.time, frame.limits.geometry_components);
    frame.camera = frame_bounds(frame.bounds, kAspect);
    frame.background = {Background::Kind::color, Vec3f(0.1f, 0.2f, 0.3f)};
    Image previous(kWidth, kHeight);
    for (const double rotation_rad : {0.0, 1.0, -2.0, 0.0}) {
        light_frame(frame, environment, 5, rotation_rad);
        const LightCoefficients light = turn_about_y(environment.coefficients(5), rotation_rad);
        DecodedPose pose;
        MeshDecoder(asset.moving()).decode(frame.time, frame.limits, pose);
        const Image expected =
            ray_cast(asset.moving().topology, from_planes(pose.positions),
                     vertex_radiance(asset.moving(), frame.time, frame.limits, light), frame.camera,
                     kWidth, kHeight, frame.background.color);
        const Image image = renderer.render(frame, kWidth, kHeight, 1);
        const Difference difference = compare(expected, image);
        EXPECT_LE(difference.mean_relative, 1e-3) << rotation_rad;
        EXPECT_LE(difference.fraction_off, 0.005) << rotation_rad;
        // The turn is to be seen.
        EXPECT_GT(compare(previous, image).fraction_off, 0.1) << rotation_rad;
        previous = image;
    }
}

// Rounded to steps, of another size in every plane.
template <typename Integer>
LowRank in_steps(const LowRank& still, float step) {
    std::vector<float> steps;
    for (uint32_t j = 0; j < still.num_planes; ++j) {
        steps.push_back(step * (1.0f + 0.5f * static_cast<float>(j % 3)));
    }
    const std::vector<float> values = still.mean_floats();
    std::vector<Integer> integers(values.size());
    for (size_t j = 0; j < values.size(); ++j) {
        integers[j] = static_cast<Integer>(std::lround(values[j] / steps[j / still.num_points]));
    }
    return LowRank::still(still.num_planes, std::move(integers), std::move(steps));
}

// Both parts as one mesh, decoded, shaded and ray-cast on the CPU.
TEST_P(SceneTest, AStillPartStandsNextToTheMovingOne) {
    for (const auto& [channels, integers] : {std::pair(1u, false), {3u, false}, {3u, true}}) {
        TestAssetOptions options;
        options.channels = channels;
        Asset asset = make_test_asset(options);
        // A still sphere of another colour that overlaps the moving one: each hides a part of the
        // other.
        options.geometry_components = options.transfer_components = 0;
        options.albedo_per_vertex = true;
        CodedMesh still = stand_still(make_test_asset(options).moving(), 1.2f);
        if (integers) {
            still.positions = in_steps<int16_t>(still.positions, 1e-4f);
            still.transfer = SvdTransfer(in_steps<int8_t>(still.transfer->matrix, 0.02f));
        }
        asset.parts.push_back(still);

        const EnvironmentLight environment(make_environment());
        SceneRenderer renderer = make_renderer(asset, environment);
        Frame frame;
        light_frame(frame, environment, 5, 0.0);
        frame.time = 1.5;
        frame.limits.bands = 4;  // fewer than there are, for both
        frame.background.kind = Background::Kind::color;
        frame.bounds = pose_bounds(asset, frame.time, frame.limits.geometry_components);
        frame.camera = frame_bounds(frame.bounds, kAspect);
        const Image drawn = renderer.render(frame, kWidth, kHeight, 1);

        const LightCoefficients light = environment.coefficients(4);
        const CodedMesh& moving = asset.moving();
        DecodedPose pose;
        MeshDecoder(moving).decode(frame.time, frame.limits, pose);
        std::vector<Vec3f> positions = from_planes(pose.positions);
        std::vector<Vec3f> radiance = vertex_radiance(moving, frame.time, frame.limits, light);
        std::vector<Vec3f> still_radiance;
        shade(still.layout, still.transfer->matrix.mean_floats(), still.albedo, light,
              still_radiance);
        const std::vector<Vec3f> still_positions = from_planes(still.positions.mean_floats());
        positions.insert(positions.end(), still_positions.begin(), still_positions.end());
        radiance.insert(radiance.end(), still_radiance.begin(), still_radiance.end());
        Topology topology = moving.topology;
        topology.append(still.topology);
        const Image expected = ray_cast(topology, positions, radiance, frame.camera, kWidth,
                                        kHeight, frame.background.color);
        const Difference difference = compare(expected, drawn);
        // Pixels at silhouettes, and where the spheres meet, may fall to either side.
        EXPECT_LT(difference.mean_relative, 2e-3) << channels;
        EXPECT_LT(difference.fraction_off, 5e-3) << channels;
    }
}

TEST_P(SceneTest, SupersamplesAreAveraged) {
    const Asset asset = make_test_asset({});
    SceneRenderer renderer = make_renderer(asset, EnvironmentLight(make_environment()));
    Frame frame;
    light_frame(frame, EnvironmentLight(make_environment()), 5, 0.0);
    frame.bounds = pose_bounds(asset, 0.0, frame.limits.geometry_components);
    frame.camera = frame_bounds(frame.bounds, kAspect);
    const Image fine = renderer.render(frame, 3 * kWidth, 3 * kHeight, 1);
    const Image averaged = renderer.render(frame, kWidth, kHeight, 3);
    const Difference difference = compare(downsample(fine, 3), averaged);
    EXPECT_EQ(difference.mean_relative, 0.0);
}

// Mesh and background of tiles fit together to the picture that is drawn in one go. Positions are
// rounded in another frame, to 1e-7 of the picture, so that the samples along edges of triangles may
// fall to either side.
TEST_P(SceneTest, TilesMakeTheSamePicture) {
    const Asset asset = make_test_asset({});
    SceneRenderer renderer = make_renderer(asset, EnvironmentLight(make_environment()));
    Frame frame;
    light_frame(frame, EnvironmentLight(make_environment()), 5, 0.7);
    frame.bounds = pose_bounds(asset, 0.0, frame.limits.geometry_components);
    frame.camera = frame_bounds(frame.bounds, kAspect);
    const Image expected = renderer.render(frame, kWidth, kHeight, 1);
    for (const Tiling& tiling :
         {Tiling{kWidth, kHeight, 32, 16}, Tiling{kWidth, kHeight, 7, kHeight}}) {
        const gl::Target target(tiling.tile_width, tiling.tile_height);
        Image picture(kWidth, kHeight);
        renderer.draw_tiles(frame, tiling, target, [&](int column, int row) {
            const Image tile = target.read();
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    if (x / tiling.tile_width != column || y / tiling.tile_height != row) continue;
                    picture.at(x, y) = tile.at(x % tiling.tile_width, y % tiling.tile_height);
                }
            }
        });
        const Difference difference = compare(expected, picture);
        EXPECT_LT(difference.mean_relative, 1e-4);
        EXPECT_LT(difference.fraction_off, 1e-3);
    }
}

// Wider than any driver draws at once: 90,000 samples.
TEST_P(SceneTest, LargePicturesAreDrawnInTiles) {
    const Asset asset = make_test_asset({});
    SceneRenderer renderer = make_renderer(asset, EnvironmentLight(make_environment()));
    Frame frame;
    light_frame(frame, EnvironmentLight(make_environment()), 5, 0.0);
    frame.bounds = pose_bounds(asset, 0.0, frame.limits.geometry_components);
    frame.camera = frame_bounds(frame.bounds, 1.0f);
    constexpr int kLarge = 11250, kSamples = 8;
    const Image tiled = renderer.render(frame, kLarge, 4, kSamples);
    // One sample a pixel fits. All but the few pixels in front of the camera see what hardly changes
    // over a pixel.
    const Image whole = renderer.render(frame, kLarge, 4, 1);
    EXPECT_LT(compare(whole, tiled).mean_relative, 1e-3);
}

TEST_P(SceneTest, EnvironmentsAreReplaced) {
    const Asset asset = make_empty_asset();
    SceneRenderer renderer = make_renderer(asset, EnvironmentLight(make_environment()));
    // Large enough not to be smoothed.
    renderer.set_environment(EnvironmentLight(Image(64, 32, Vec3f(0.5f, 0.25f, 4.0f))));
    const Image after = renderer.render({}, kWidth, kHeight, 1);
    for (const Vec3f& pixel : after.pixels) ASSERT_EQ(pixel, Vec3f(0.5f, 0.25f, 4.0f));
}

TEST_P(SceneTest, RefusesPicturesBeyondTheDriversLimit) {
    const int too_much = gl::max_target_size() + 1;
    try {
        gl::Target(too_much, 4);
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_NE(std::string(error.what()).find(std::to_string(too_much)), std::string::npos);
    }
}

TEST_P(SceneTest, RefusedShadersAreNamedWithTheDriversLog) {
    try {
        gl::Program("nonsense", "void main() { gl_Position = vec4(0.0); }",
                    "out vec4 c; void main() { c = undeclared; }");
        FAIL() << "expected an error";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("shader nonsense, fragment stage"), std::string::npos) << message;
        EXPECT_NE(message.find("undeclared"), std::string::npos) << message;
    }
}

// A framebuffer of eight bits, like a window's.
class ByteTarget {
  public:
    ByteTarget(int width, int height) : width_(width), height_(height) {
        glBindTexture(GL_TEXTURE_2D, color_.id());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     nullptr);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.id(), 0);
        glViewport(0, 0, width, height);
    }
    std::vector<std::array<uint8_t, 4>> read() const {
        std::vector<std::array<uint8_t, 4>> pixels(static_cast<size_t>(width_ * height_));
        glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        return pixels;
    }

  private:
    int width_;
    int height_;
    gl::TextureHandle color_;
    gl::FramebufferHandle framebuffer_;
};

TEST_P(SceneTest, ToneMapperAgreesWithToneCurve) {
    constexpr int kSamples = 2;
    const gl::Target picture(kSamples * kWidth, kSamples * kHeight);
    const Asset asset = make_empty_asset();
    SceneRenderer renderer = make_renderer(asset, EnvironmentLight(make_environment()));
    renderer.draw({}, picture);
    const Image image = downsample(picture.read(), kSamples);
    const ToneMapper mapper;
    for (const ToneCurve& curve :
         {ToneCurve{0.0f, 0.0f}, ToneCurve{-2.5f, 0.0f}, ToneCurve{1.0f, 2.2f},
          ToneCurve{-6.0f, 0.0f}, ToneCurve{-9.0f, 0.0f},
          ToneCurve{0.0f, 0.0f, ToneOperator::reinhard},
          ToneCurve{3.0f, 2.2f, ToneOperator::reinhard}, ToneCurve{-2.0f, 0.0f, ToneOperator::aces},
          ToneCurve{1.0f, 2.2f, ToneOperator::aces}, ToneCurve{30.0f, 0.0f, ToneOperator::aces}}) {
        const ByteTarget target(kWidth, kHeight);
        mapper.draw(picture, kSamples, curve);
        gl::check_errors("testing");
        const auto pixels = target.read();
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                for (int channel = 0; channel < 3; ++channel) {
                    // One level: a value on the border of two may fall on either side.
                    ASSERT_NEAR(pixels[static_cast<size_t>((kHeight - 1 - y) * kWidth + x)]
                                      [static_cast<size_t>(channel)],
                                curve.apply(image.at(x, y)[channel]), 1);
                }
            }
        }
    }
}

// Mesh, edges, environment and coloured background, drawn through the curve at once.
TEST_P(SceneTest, DisplayTargetsShowWhatTheToneCurveMakesOfRadiance) {
    const Asset asset = make_test_asset({});
    SceneRenderer renderer = make_renderer(asset, EnvironmentLight(make_environment()));
    Frame frame;
    light_frame(frame, EnvironmentLight(make_environment()), 5, 0.3);
    frame.bounds = pose_bounds(asset, 0.0, frame.limits.geometry_components);
    frame.camera = frame_bounds(frame.bounds, kAspect);
    const gl::Target radiance(kWidth, kHeight);
    const gl::Target display(kWidth, kHeight, gl::TargetKind::display);
    for (const bool plain : {false, true}) {
        frame.edges = plain;
        frame.background.kind = plain ? Background::Kind::color : Background::Kind::environment;
        frame.background.color = Vec3f(0.2f, 0.7f, 4.0f);
        for (const ToneCurve& curve : {ToneCurve{-0.5f, 0.0f, ToneOperator::aces},
                                       ToneCurve{0.5f, 2.2f, ToneOperator::reinhard}}) {
            frame.display.reset();
            renderer.draw(frame, radiance);
            const Image image = radiance.read();
            frame.display = curve;
            renderer.draw(frame, display);
            std::vector<std::array<uint8_t, 4>> shown(static_cast<size_t>(kWidth * kHeight));
            glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, shown.data());
            gl::check_errors("testing");
            for (int y = 0; y < kHeight; ++y) {
                for (int x = 0; x < kWidth; ++x) {
                    const auto& pixel = shown[static_cast<size_t>((kHeight - 1 - y) * kWidth + x)];
                    for (int channel = 0; channel < 3; ++channel) {
                        ASSERT_NEAR(pixel[static_cast<size_t>(channel)],
                                    curve.apply(image.at(x, y)[channel]), 1)
                            << x << ", " << y;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace paim::player
