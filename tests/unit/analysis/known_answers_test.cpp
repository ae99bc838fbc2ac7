// Error curves where the answer is known beforehand.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/budget/error_budget.h"
#include "analysis/measure.h"
#include "analysis/reference/enough_rays.h"
#include "analysis/reference/reference_kind.h"
#include "analysis/scratch_encode.h"
#include "compressor/bake/bake_sequence.h"
#include "paim/light/sky.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kKnownBands = 4;

class KnownAnswers : public testing::Test {
  protected:
    BakeReader bake(const PoseSource& source, uint32_t rays = 64) {
        BakeOptions options;
        options.bands = kKnownBands;
        options.rays = rays;
        const auto path = directory_ / "x.bake";
        bake_sequence(source, options, "faces", path, 0, source.num_poses() - 1, [](uint32_t) {});
        return BakeReader(path);
    }

    Asset encode_all(const BakeReader& bake) const {
        EncodeOptions options;
        options.geometry.kind = ComponentChoice::Kind::all;
        options.transfer.kind = ComponentChoice::Kind::all;
        return encode_in_memory(bake, options, directory_.path());
    }

    // A light whose coefficients end with this many bands, by the sky's.
    static NamedLight light_of_bands(int bands) {
        const EnvironmentLight sky(make_sky());
        NamedLight light{"light", sky, sky.coefficients(kKnownBands)};
        for (size_t i = 0; i < light.coefficients.values.size(); ++i) {
            if (static_cast<int>(i) >= bands * bands) light.coefficients.values[i].setZero();
        }
        return light;
    }

    static std::vector<Curve> measure(const BakeReader& bake, const Asset& asset,
                                      const Stage& stage) {
        std::vector<Curve> curves = plan_curves(bake, asset, {1}, {3, 2, 1});
        const Reference reference = make_reference(ReferenceKind::bake, 0, bake, stage);
        measure_curves(bake, asset, stage, reference.source, curves, [] {});
        return curves;
    }

    static StageOptions small_stage() {
        StageOptions options;
        options.size_pixels = 64;
        options.num_views = 2;
        options.num_poses = 2;
        options.elevation_rad = 0.3;
        return options;
    }

    const TemporaryDirectory directory_;
};

// Bands that the light does not have cost nothing to leave out.
TEST_F(KnownAnswers, ALightOfTwoBandsNeedsTwo) {
    const BakeReader reader = bake(poses::make_octopus(1000, 3));
    const Stage stage(reader, {light_of_bands(2)}, small_stage());
    const std::vector<Curve> curves = measure(reader, encode_all(reader), stage);
    const Curve& bands = curves.back();
    ASSERT_EQ(bands.points.size(), 4u);
    for (const CurvePoint& point : bands.points) {
        const double error = point.seen[0].visual_error();
        if (point.value >= 2) {
            // Components in floats, rebuilt.
            EXPECT_LT(error, 1e-6) << point.value;
        } else {
            EXPECT_GT(error, 0.05) << point.value;
        }
    }
}

// On a convex body under constant light all is open, and a single number, the mean, holds it.
TEST_F(KnownAnswers, ASphereInConstantLightHasNoError) {
    const auto sphere = poses::make_sphere_sequence(500);
    const BakeReader reader = bake(poses::make_pose_set(*sphere, 3));
    const Stage stage(reader, {light_of_bands(1)}, small_stage());
    for (const Curve& curve : measure(reader, encode_all(reader), stage)) {
        for (const CurvePoint& point : curve.points) {
            if (curve.name == "geometry_components" && point.value == 0) continue;
            EXPECT_LT(point.seen[0].visual_error(), 1e-6) << curve.name << ' ' << point.value;
        }
    }
}

// A tenth more of everything is an E6 of a tenth, in every picture.
TEST_F(KnownAnswers, ATenthMoreTransferIsSeenAsATenth) {
    const BakeReader reader = bake(poses::make_octopus(1000, 3));
    Asset asset = encode_all(reader);
    LowRank& matrix = asset.moving().transfer->matrix;
    const auto scale = [](StoredValues& values) {
        std::vector<float> floats = values.floats();
        for (float& value : floats) value *= 1.1f;
        values = std::move(floats);
    };
    scale(matrix.mean);
    for (StoredValues& component : matrix.components) scale(component);
    const Stage stage(reader, {light_of_bands(kKnownBands)}, small_stage());
    const std::vector<Curve> curves = measure(reader, asset, stage);
    const PictureErrors& seen = curves[0].points[0].seen[0];
    EXPECT_NEAR(seen.visual_error(), 0.1, 1e-6);
    EXPECT_NEAR(seen.spread().least, 0.1, 1e-6);
    EXPECT_NEAR(seen.spread().most, 0.1, 1e-6);
    EXPECT_NEAR(curves[0].points[0].transfer.relative(), 0.1, 1e-6);
}

// The damaged vertex is found and named, with its pose.
TEST_F(KnownAnswers, TheWorstVertexIsTheDamagedOne) {
    const BakeReader reader = bake(poses::make_octopus(1000, 3));
    Asset asset = encode_all(reader);
    std::vector<float> mean = asset.moving().positions.mean.floats();
    mean[123] += 0.5f;
    asset.moving().positions.mean = std::move(mean);
    const Stage stage(reader, {light_of_bands(kKnownBands)}, small_stage());
    const CurvePoint point = measure(reader, asset, stage)[0].points[0];
    EXPECT_EQ(point.distance.worst_vertex, 123u);
    EXPECT_NEAR(point.distance.worst, 0.5, 1e-5);
}

// Causes of a file with all components as floats: what compression costs is rounding. The rest is
// there, and all together are at most the sum.
TEST_F(KnownAnswers, BudgetOfAFileWithEverything) {
    const BakeReader reader = bake(poses::make_octopus(1000, 2));
    const EnvironmentLight sky(make_sky());
    const Stage stage(reader, {{"sky", sky, sky.coefficients(kKnownBands)}}, small_stage());
    size_t steps = 0;
    const ErrorBudget budget =
        measure_budget(reader, encode_all(reader), stage, 64, directory_.path(), [&] { ++steps; });
    EXPECT_EQ(steps, budget_steps(stage));
    ASSERT_EQ(budget.terms.size(), 7u);
    double largest = 0.0;
    for (const BudgetTerm& term : budget.terms) {
        const double error = term.errors[0].visual_error();
        const std::string name = term.name;
        const bool is_lost = name == "interpolation" || name == "bands" || name == "noise";
        if (is_lost) {
            EXPECT_GT(error, 1e-3) << name;
        } else {
            // Rounding moves a few pixels of outlines.
            EXPECT_LT(error, 2e-3) << name;
        }
        largest = std::max(largest, error);
    }
    // Pixel by pixel, by the triangle inequality; rounding of sums.
    EXPECT_LE(budget.whole[0].visual_error(), budget.sum(0) * (1.0 + 1e-9));
    EXPECT_GE(budget.whole[0].visual_error(), largest);
    EXPECT_GT(budget.pixel_noise[0], 0.0);
}

// As many rays as it takes for a fifth of the error, and no more than a person asked for.
TEST_F(KnownAnswers, ReferencesTakeEnoughRays) {
    const BakeReader reader = bake(poses::make_octopus(1000, 2), 256);
    const EnvironmentLight sky(make_sky());
    const Stage stage(reader, {{"sky", sky, sky.coefficients(kKnownBands)}}, small_stage());
    Reference reference = make_reference(ReferenceKind::traced, 0, reader, stage);
    EXPECT_TRUE(reference.rays_were_chosen);
    const DecodedPose baked = baked_pose(reader, 0, reader.read_pose(0));
    const ReferencePictures traced = reference.source(0, baked);
    RelativeNoise noise(1);
    noise.add(traced);
    ImageError error;
    const std::vector<Image> pictures = stage.render_pose(baked);
    for (size_t j = 0; j < pictures.size(); ++j) {
        error.add(compare_images(pictures[j], traced.pictures[j]));
    }
    EXPECT_LT(noise.relative()[0], kNoiseOfError * error.visual_error());
    EXPECT_EQ(noise_note(reference, stage, 0, noise.relative()[0], error.visual_error()), "");
    reference = make_reference(ReferenceKind::traced, 8, reader, stage);
    EXPECT_EQ(reference.traced->rays(0), 8u);
    EXPECT_NE(noise_note(reference, stage, 0, 0.3 * error.visual_error(), error.visual_error()),
              "");
}

}  // namespace
}  // namespace paim
