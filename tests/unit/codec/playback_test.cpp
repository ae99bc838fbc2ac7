// Playback on the CPU: its results against decoding and shading, and when it computes them again.
#include "paim/codec/playback.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "paim/codec/mesh_decoder.h"
#include "paim/shade/shade.h"
#include "tests/example_asset.h"
#include "tests/random_light.h"

namespace paim {
namespace {

// Every codec, as floats and as integers, with a colour at each vertex and with a still part.
struct Variant {
    std::string name;
    std::shared_ptr<const Asset> asset;
};

std::vector<Variant> make_variants() {
    std::vector<Variant> variants;
    for (const uint32_t channels : {1u, 3u}) {
        const auto add = [&](const char* name, Asset asset) {
            CodedMesh& mesh = asset.moving();
            mesh.albedo.values = {{0.9f, 0.5f, 0.1f}, {0, 1, 0}, {0.3f, 0.4f, 0.5f}, {1, 1, 1}};
            asset.parts.push_back(make_quantised_still(mesh.layout));
            variants.push_back({std::string(name) + ", " + std::to_string(channels) + " channels",
                                std::make_shared<const Asset>(std::move(asset))});
        };
        add("svd", make_example_asset(3, channels));
        add("svd of integers", quantise_example(make_example_asset(3, channels)));
        add("cpca", make_clustered_example(3, channels, 2));
        add("cpca of integers", make_clustered_example(3, channels, 2, true));
    }
    return variants;
}

// Radiance and positions of a part are those of decode() and shade().
void expect_as_decoded(const Playback& playback, size_t number, double time,
                       const DecodeLimits& limits, const LightCoefficients& light) {
    const CodedMesh& mesh = playback.asset().parts[number];
    DecodedPose pose;
    MeshDecoder(mesh).decode(time, limits, pose);
    const auto positions = playback.positions(number);
    EXPECT_EQ(std::vector<float>(positions.begin(), positions.end()), pose.positions);
    std::vector<Vec3f> expected;
    shade(pose.layout, pose.transfer, mesh.albedo, light, expected);
    const auto radiance = playback.radiance(number);
    ASSERT_EQ(radiance.size(), expected.size());
    // Radiance is a sum of 9 coefficients, and each of 3 rows of a cluster, of which each is a sum
    // of 4 values. The codecs take these sums in different orders: 108 terms round 2^-24 each of a
    // magnitude that is at most this many times the largest coefficient, as values and lights are
    // at most 1.
    float largest = 0.0f;
    for (const float t : pose.transfer) largest = std::max(largest, std::abs(t));
    const double tolerance = 108.0 * 0x1p-24 * 9.0 * 3.0 * double{largest};
    EXPECT_GT(largest, 0.1f);
    for (size_t v = 0; v < expected.size(); ++v) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(radiance[v][c], expected[v][c], tolerance) << v << ' ' << c;
        }
    }
}

TEST(Playback, ShowsWhatDecodingAndShadingGive) {
    const LightCoefficients light = random_light(3, 1);
    for (const Variant& variant : make_variants()) {
        SCOPED_TRACE(variant.name);
        Playback playback(variant.asset);
        ASSERT_EQ(playback.num_parts(), 2u);
        playback.set_light(DistantLight(light));
        for (const DecodeLimits& limits :
             {DecodeLimits{}, DecodeLimits{1, 2, 2, 1}, DecodeLimits{0, 0, 1, 0}}) {
            for (const double time : {0.0, 1.0, 2.75, 4.0}) {
                playback.update(time, limits);
                expect_as_decoded(playback, 0, time, limits, light);
                expect_as_decoded(playback, 1, 0.0, limits, light);
            }
        }
    }
}

// One thing changes at a time: the light, the time, and each of the limits. Parts that keep what
// they computed before must notice each of these changes.
TEST(Playback, ComputesAnewWhatChanged) {
    for (const Variant& variant : make_variants()) {
        SCOPED_TRACE(variant.name);
        Playback playback(variant.asset);
        playback.update(1.5);
        EXPECT_TRUE(playback.radiance().empty());
        LightCoefficients light = random_light(3, 1);
        playback.set_light(DistantLight(light));
        playback.update(1.5);
        expect_as_decoded(playback, 0, 1.5, {}, light);
        // Twice, as codecs keep the pose from the second time on.
        for (const uint64_t seed : {2u, 3u}) {
            light = random_light(3, seed);
            playback.set_light(DistantLight(light));
            playback.update(1.5);
            expect_as_decoded(playback, 0, 1.5, {}, light);
            expect_as_decoded(playback, 1, 0.0, {}, light);
        }
        playback.update(3.25);
        expect_as_decoded(playback, 0, 3.25, {}, light);
        for (const DecodeLimits& limits :
             {DecodeLimits{.geometry_components = 1}, DecodeLimits{.transfer_components = 1},
              DecodeLimits{.bands = 2}, DecodeLimits{.vertex_components = 1}, DecodeLimits{}}) {
            playback.update(3.25, limits);
            expect_as_decoded(playback, 0, 3.25, limits, light);
        }
    }
}

// A time beyond either end shows the pose at that end, however far away it is. A time that is not a
// number shows the first pose. No pose beyond the last is read.
TEST(Playback, ClampsEveryTime) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const std::vector<std::pair<double, double>> times{
        {kNaN, 0.0},    {-kNaN, 0.0}, {-kInfinity, 0.0}, {-1e300, 0.0},
        {-1e-300, 0.0}, {-0.0, 0.0},  {4.0 + 1e-9, 4.0}, {5.0, 4.0},
        {1e19, 4.0},    {1e300, 4.0}, {kInfinity, 4.0}};
    const LightCoefficients light = random_light(3, 1);
    for (const Variant& variant : make_variants()) {
        SCOPED_TRACE(variant.name);
        Playback playback(variant.asset);
        playback.set_light(DistantLight(light));
        MeshDecoder decoder(variant.asset->moving());
        DecodedPose pose, expected;
        for (const auto& [time, shown] : times) {
            SCOPED_TRACE(time);
            playback.update(2.0);
            playback.update(time);
            expect_as_decoded(playback, 0, shown, {}, light);
            decoder.decode(time, {}, pose);
            decoder.decode(shown, {}, expected);
            EXPECT_EQ(pose.positions, expected.positions);
            EXPECT_EQ(pose.transfer, expected.transfer);
        }
    }
}

// Lights differ from place to place; each part asks at the middle of its mean pose.
class LightOfPlaces : public LightField {
  public:
    LightCoefficients at(const Vec3f& place, int bands) const override {
        LightCoefficients light{bands, {}};
        light.values.assign(static_cast<size_t>(bands * bands), place);
        return light;
    }
};

TEST(Playback, AsksForTheLightAtTheMiddleOfEachPart) {
    const auto asset = std::make_shared<const Asset>(
        with_still(make_example_asset(2, 3), make_example_still({TransferKind::diffuse, 2, 3})));
    Playback playback(asset);
    playback.set_light(LightOfPlaces());
    playback.update(3.0);
    for (size_t number = 0; number < 2; ++number) {
        const CodedMesh& mesh = asset->parts[number];
        const std::vector<float> planes = mesh.positions.mean_floats();
        Vec3f middle;
        for (int axis = 0; axis < 3; ++axis) {
            const auto [least, most] =
                std::minmax_element(planes.begin() + 4 * axis, planes.begin() + 4 * axis + 4);
            middle[axis] = 0.5f * (*least + *most);
        }
        expect_as_decoded(playback, number, number == 0 ? 3.0 : 0.0, {},
                          LightOfPlaces().at(middle, 2));
    }
}

// A vertex of no face does not move the middle.
TEST(Playback, AsksForTheLightAtTheMiddleOfTheFaces) {
    Asset asset = make_example_asset(2, 3);
    asset.moving().topology.triangles = {{1, 2, 1}};
    asset.moving().positions.mean =
        std::vector<float>{90, 1, 2, 80, 70, 3, 5, 60, -50, -6, -4, -40};
    const auto shared = std::make_shared<const Asset>(asset);
    Playback playback(shared);
    playback.set_light(LightOfPlaces());
    playback.update(3.0);
    expect_as_decoded(playback, 0, 3.0, {}, LightOfPlaces().at({1.5f, 4, -5}, 2));
}

// The colours of images replace the albedo, so that radiance is needed without it.
TEST(Playback, KeepsTheRadianceOfAWhiteSurfaceOnDemand) {
    for (const Variant& variant : make_variants()) {
        auto textured = std::make_shared<Asset>(*variant.asset);
        textured->moving().texture.images.emplace_back();
        const LightCoefficients light = random_light(3, 7);
        Playback plain(textured), both(textured);
        both.keep_white_radiance(true);
        for (Playback* const playback : {&plain, &both}) {
            playback->set_light(DistantLight(light));
            playback->update(0.5);
        }
        EXPECT_TRUE(plain.white_radiance(0).empty()) << variant.name;
        // The still part has no texture.
        EXPECT_TRUE(both.white_radiance(1).empty()) << variant.name;
        const auto white = both.white_radiance(0);
        const auto lit = both.radiance(0), expected = plain.radiance(0);
        ASSERT_EQ(white.size(), expected.size());
        const Albedo& albedo = textured->moving().albedo;
        for (uint32_t v = 0; v < expected.size(); ++v) {
            // One product is rounded once either way.
            EXPECT_EQ(lit[v], expected[v]) << variant.name;
            EXPECT_EQ(lit[v], albedo.at(v).cwiseProduct(white[v])) << variant.name;
            EXPECT_FALSE(white[v].isZero(0.0f)) << variant.name;
        }
        both.keep_white_radiance(false);
        both.update(0.5);
        EXPECT_TRUE(both.white_radiance(0).empty()) << variant.name;
        EXPECT_EQ(both.radiance(0)[1], expected[1]) << variant.name;
    }
}

}  // namespace
}  // namespace paim
