// paim-play's pictures of a baked, compressed octopus against the ray-cast reference renderer.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/encode.h"
#include "compressor/encode/search/target_encode.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/image/exr.h"
#include "paim/image/tone.h"
#include "paim/light/environment.h"
#include "paim/light/sky.h"
#include "paim/mesh/planes.h"
#include "paim/metrics/image_error.h"
#include "paim/render/render.h"
#include "paim/shade/shade.h"
#include "player/view/framing.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/cli/run_tool.h"
#include "tests/player/two_lamps.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

// Pixels at edges may show either side of the edge. Elsewhere both pictures agree to two steps of
// eight bits.
void expect_same_picture(const Image& expected, const Image& drawn, const std::string& what) {
    const ToneCurve curve;
    size_t covered = 0, off = 0;
    for (size_t j = 0; j < expected.pixels.size(); ++j) {
        if (expected.pixels[j].isZero(0.0f) && drawn.pixels[j].isZero(0.0f)) continue;
        ++covered;
        for (int channel = 0; channel < 3; ++channel) {
            const int difference =
                curve.apply(expected.pixels[j][channel]) - curve.apply(drawn.pixels[j][channel]);
            if (std::abs(difference) > 2) {
                ++off;
                break;
            }
        }
    }
    const double error = compare_images(drawn, expected).visual_error();
    const double share = static_cast<double>(off) / static_cast<double>(covered);
    EXPECT_GT(covered, 5000u) << what;  // the octopus is in the picture
    EXPECT_LE(error, 1e-3) << what;
    // Of the octopus's own pixels, which is stricter than of the image's.
    EXPECT_LE(share, 5e-3) << what;
}

class Pictures : public testing::Test {
  protected:
    Image reference(double time, const Image& environment, double turn_rad) const {
        const CodedMesh& moving = asset_.moving();
        DecodedPose pose;
        MeshDecoder(moving).decode(time, {}, pose);
        const LightCoefficients light =
            turn_about_y(EnvironmentLight(environment).coefficients(5), turn_rad);
        std::vector<std::vector<Vec3f>> radiance(1);
        shade(pose.layout, pose.transfer, moving.albedo, light, radiance[0]);
        std::vector<Vec3f> positions = from_planes(pose.positions);
        Topology topology = moving.topology;
        if (const CodedMesh* const still = asset_.still()) {
            std::vector<Vec3f> still_radiance;
            shade(still->layout, still->transfer->matrix.mean_floats(), still->albedo, light,
                  still_radiance);
            radiance[0].insert(radiance[0].end(), still_radiance.begin(), still_radiance.end());
            const std::vector<Vec3f> still_positions = from_planes(still->positions.mean_floats());
            positions.insert(positions.end(), still_positions.begin(), still_positions.end());
            topology.append(still->topology);
        }
        const Camera camera =
            player::frame_asset(asset_, kDefaultAzimuth_rad, kDefaultElevation_rad,
                                static_cast<float>(kWidth) / kHeight);
        return render_images(topology, positions, radiance, camera, kWidth, kHeight)[0];
    }

    Image snapshot(double time, const std::vector<std::string>& light_arguments) const {
        std::vector<std::string> arguments{PAIM_PLAY,       (directory_ / "x.paim").string(),
                                           "--snapshot",    (directory_ / "x.exr").string(),
                                           "--pose",        std::to_string(time),
                                           "--size",        fmt::format("{}x{}", kWidth, kHeight),
                                           "--supersample", "1",
                                           "--background",  "black"};
        arguments.insert(arguments.end(), light_arguments.begin(), light_arguments.end());
        const ToolResult result = run_tool(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_exr(directory_ / "x.exr");
    }

    TemporaryDirectory directory_;
    Asset asset_;
};

class Reference : public Pictures {
  protected:
    Reference() {
        const PoseSet octopus = poses::make_octopus(4000, 6);
        const BakeOptions options{5, 64, 1};
        Surroundings surroundings;
        surroundings.still_mesh.add(poses::make_pose_set(*poses::make_box_sequence(200), 1));
        bake_sequence(
            octopus, options, "faces", directory_ / "x.bake", 0, 5, [](uint32_t) {}, surroundings);
        encode(BakeReader(directory_ / "x.bake"), {}, directory_ / "x.paim");
        asset_ = read_paim(directory_ / "x.paim");
    }
};

TEST_F(Reference, PlayerAgreesInThreePosesUnderTwoLights) {
    write_exr(directory_ / "lamps.exr", player::make_two_lamps());
    const std::string lamps = (directory_ / "lamps.exr").string();
    for (const double time : {0.0, 2.0, 4.5}) {
        for (const bool use_sky : {true, false}) {
            const double turn_deg = 40.0 * time;
            std::vector<std::string> arguments{"--env-rotation", std::to_string(turn_deg)};
            if (!use_sky) arguments.insert(arguments.end(), {"--env", lamps});
            const Image expected =
                reference(time, use_sky ? make_sky() : read_exr(lamps), turn_deg * kPi / 180.0);
            expect_same_picture(expected, snapshot(time, arguments),
                                fmt::format("{} {}", time, use_sky ? "sky" : "lamps"));
        }
    }
}

// Files of both codecs that meet a target hold integers.
TEST_F(Reference, PlayerAgreesOnIntegersOfBothCodecs) {
    const BakeReader bake(directory_ / "x.bake");
    EncodeOptions options;
    options.precision = Precision::i16;
    for (const std::string codec : {"svd", "cpca"}) {
        EncodeTarget target;
        target.transfer_error = 0.3;
        target.codec = codec;
        target.spectrum = BandPower::flat(bake.identity().layout.in_bands);
        encode_to_target(bake, options, target, directory_ / "x.paim");
        asset_ = read_paim(directory_ / "x.paim");
        const LowRank& matrix = asset_.moving().transfer->matrix;
        ASSERT_EQ(asset_.moving().transfer->codec_name(), codec);
        ASSERT_FALSE(matrix.components.empty() || matrix.components[0].holds_floats()) << codec;
        for (const double time : {1.0, 4.5}) {
            expect_same_picture(reference(time, make_sky(), 0.0), snapshot(time, {}),
                                fmt::format("{} {}", codec, time));
        }
    }
}

// The same poses at other sizes through bake, encoder, player and reference renderer. Powers of two
// scale exactly; what the encoder rounds differently shows in no picture of eight bits beyond a
// step.
TEST_F(Pictures, DoNotDependOnTheSize) {
    const PoseSet octopus = poses::make_octopus(1000, 2);
    std::vector<std::array<uint8_t, 3>> first_drawn, first_expected;
    for (const int exponent : {0, -90, -70, 70, 90}) {
        std::vector<std::vector<Vec3f>> positions;
        for (uint32_t p = 0; p < octopus.num_poses(); ++p) {
            positions.push_back(octopus.load_pose(p).positions);
            for (Vec3f& x : positions.back()) x *= std::ldexp(1.0f, exponent);
        }
        const PoseSet scaled(octopus.topology(), std::move(positions), octopus.albedo());
        const std::filesystem::path bake = directory_ / std::to_string(exponent);
        bake_sequence(scaled, {3, 16, 1}, "faces", bake, 0, 1, [](uint32_t) {});
        encode(BakeReader(bake), {}, directory_ / "x.paim");
        asset_ = read_paim(directory_ / "x.paim");
        const auto drawn = tone_map(snapshot(0.5, {}), {});
        const auto expected = tone_map(reference(0.5, make_sky(), 0.0), {});
        if (exponent == 0) {
            first_drawn = drawn;
            first_expected = expected;
        }
        for (size_t j = 0; j < drawn.size(); ++j) {
            for (size_t channel = 0; channel < 3; ++channel) {
                ASSERT_NEAR(drawn[j][channel], first_drawn[j][channel], 1) << exponent;
                ASSERT_NEAR(expected[j][channel], first_expected[j][channel], 1) << exponent;
            }
        }
    }
}

}  // namespace
}  // namespace paim
