// A renderer that is given another asset draws it like one that had it from the start.
#include <gtest/gtest.h>

#include "paim/codec/sequence_bounds.h"
#include "paim/light/sky.h"
#include "player/gl/headless_context.h"
#include "player/render/scene_renderer.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

constexpr int kWidth = 60, kHeight = 40;

Image draw(SceneRenderer& renderer, const Asset& asset) {
    Frame frame;
    frame.time = 1.25;
    light_frame(frame, EnvironmentLight(make_sky()), static_cast<int>(renderer.most().bands), 0.7);
    frame.bounds = sequence_bounds(asset);
    frame.camera = frame_bounds(frame.bounds, static_cast<float>(kWidth) / kHeight);
    return renderer.render(frame, kWidth, kHeight, 1);
}

TEST(PrefixRenderer, DrawsAnotherAssetAsIfItWereTheFirst) {
    const auto context = gl::make_headless_context();
    TestAssetOptions options;
    const auto whole = std::make_shared<const Asset>(make_test_asset(options));
    options.geometry_components = 1;
    options.transfer_components = 2;
    const auto coarse = std::make_shared<const Asset>(make_test_asset(options));
    options.bands = 3;  // projects the light again
    options.num_poses = 4;
    const auto other = std::make_shared<const Asset>(make_test_asset(options));
    for (const Decoder decoder : {Decoder::gpu, Decoder::cpu}) {
        SceneRenderer renderer(other, {}, {}, decoder);
        Image last = draw(renderer, *other);
        for (const auto& asset : {coarse, whole, other, coarse}) {
            renderer.set_asset(asset, {}, {});
            const Image image = draw(renderer, *asset);
            EXPECT_NE(image.pixels, last.pixels);
            SceneRenderer fresh(asset, {}, {}, decoder);
            EXPECT_EQ(image.pixels, draw(fresh, *asset).pixels);
            EXPECT_EQ(renderer.texture_bytes(), fresh.texture_bytes());
            last = image;
        }
    }
}

}  // namespace
}  // namespace paim::player
