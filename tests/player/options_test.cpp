// The command line of paim-play: every option lands in its own place.
#include "player/options.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace paim::player {
namespace {

Options parse(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "paim-play");
    Options options;
    EXPECT_EQ(parse_options(static_cast<int>(arguments.size()), arguments.data(), options), -1);
    return options;
}

ViewState view_of(const Options& options) {
    ViewState view;
    for (const auto& change : options.view_changes) change(view);
    return view;
}

TEST(PlayOptions, AreConvertedToTheirUnits) {
    const Options options =
        parse({"a.paim",   "--pose",       "2.5",           "--size",     "40x30",
               "--camera", "90,-45,3",     "--env",         "light.exr",  "--env-rotation",
               "180",      "--background", "0,0.5,1",       "--exposure", "-2",
               "--gamma",  "2.2",          "--supersample", "3",          "--snapshot",
               "b.exr",    "--json",       "--progressive", "--tone-map", "aces"});
    EXPECT_EQ(options.model_path, "a.paim");
    const ViewState view = view_of(options);
    EXPECT_EQ(view.animation.time, 2.5);
    EXPECT_EQ(options.size, std::pair(40, 30));
    ASSERT_TRUE(options.camera);
    EXPECT_DOUBLE_EQ(options.camera->azimuth_rad, kPi / 2.0);
    EXPECT_DOUBLE_EQ(options.camera->elevation_rad, -kPi / 4.0);
    EXPECT_EQ(options.camera->distance_factor, 3.0);
    EXPECT_EQ(options.environment_path, "light.exr");
    EXPECT_EQ(view.light.orientation.yaw_deg, 180.0);
    EXPECT_EQ(view.background.kind, Background::Kind::color);
    EXPECT_EQ(view.background.color, Vec3f(0.0f, 0.5f, 1.0f));
    EXPECT_EQ(view.tone_curve, (ToneCurve{-2.0f, 2.2f, ToneOperator::aces}));
    EXPECT_EQ(options.supersample, 3);
    EXPECT_EQ(options.snapshot_path, "b.exr");
    EXPECT_TRUE(options.json);
    EXPECT_TRUE(options.play_prefix);
    EXPECT_FALSE(options.opens_window());
}

TEST(PlayOptions, HaveDefaults) {
    const Options options = parse({"a.paim"});
    EXPECT_EQ(view_of(options), ViewState());
    EXPECT_EQ(options.size, std::pair(1280, 720));
    EXPECT_FALSE(options.camera || options.target || options.view_path || options.save_view_path ||
                 options.clip || options.auto_exposure);
    EXPECT_FALSE(options.environment_path || options.supersample || options.bench_frames ||
                 options.window_frames || options.json || options.play_prefix);
    EXPECT_EQ(options.decoder, Decoder::automatic);
    EXPECT_TRUE(options.opens_window());
    EXPECT_FALSE(parse({"a.paim", "--bench", "7"}).opens_window());
    EXPECT_EQ(parse({"a.paim", "--bench", "7"}).bench_frames, 7);
    EXPECT_EQ(parse({"a.paim", "--frames", "8"}).window_frames, 8);
    EXPECT_TRUE(parse({"a.paim", "--frames", "8"}).opens_window());
}

TEST(PlayOptions, LimitWhatIsAskedForAndNothingElse) {
    const Options options = parse({"a.paim", "--geometry-components", "0", "--bands", "4",
                                   "--cluster-components", "1000000000"});
    EXPECT_EQ(options.wanted.geometry_components, 0u);
    EXPECT_FALSE(options.wanted.transfer_components);
    EXPECT_EQ(options.wanted.bands, 4u);
    ASSERT_TRUE(options.wanted.vertex_components);
    EXPECT_EQ(options.wanted.vertex_components->count, 1000000000u);
    EXPECT_EQ(options.wanted.vertex_components->words->codec, "cpca");
    const DecodeLimits limits = options.wanted.limits();
    EXPECT_EQ(limits.geometry_components, 0u);
    EXPECT_EQ(limits.transfer_components, std::numeric_limits<uint32_t>::max());
    EXPECT_EQ(limits.bands, 4u);
    EXPECT_EQ(limits.vertex_components, 1000000000u);
    EXPECT_EQ(parse({"a.paim", "--transfer-components", "3"}).wanted.limits().transfer_components,
              3u);
}

}  // namespace
}  // namespace paim::player
