// Models of every size become one.
#include "player/read_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/codec/pose_parts.h"
#include "paim/codec/sequence_bounds.h"
#include "player/report.h"
#include "player/scene.h"
#include "tests/first_components.h"
#include "tests/player/test_model.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

// With scenery that reaches ten times as far.
Model make_model(Precision precision) {
    TestModelOptions options;
    options.precision = precision;
    Model model = make_test_model(options);
    std::vector<float> positions = make_test_model({}).geometry.mean.floats();
    for (float& x : positions) x *= 10.0f;
    StillPlanes scenery(std::move(positions));
    if (is_integer(precision)) {
        std::vector<int16_t> integers;
        for (const float x : scenery.values.floats()) {
            integers.push_back(static_cast<int16_t>(std::lround(1000.0f * x)));
        }
        scenery = StillPlanes(StoredValues(std::move(integers)), {1e-3f, 1e-3f, 1e-3f});
    }
    const size_t num_values = size_t{model.layout.num_planes()} * model.topology.num_vertices;
    model.scenery = {model.topology, model.albedo, std::move(scenery),
                     StillPlanes(std::vector<float>(num_values, 0.1f))};
    return model;
}

// Coordinates near zero may have lost digits where they were scaled down: they were rounded to 2^-149
// at 2^-90 of their size, and all that is added up has fewer than eight terms.
void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t j = 0; j < a.size(); ++j) ASSERT_NEAR(a[j], b[j], 8.0 * 0x1p-59) << j;
}

void expect_same_geometry(const Model& a, const Model& b) {
    for (const double time : {0.0, 2.5}) {
        DecodedPose pose_a, pose_b;
        decode_positions(a, time, {}, pose_a);
        decode_positions(b, time, {}, pose_b);
        expect_same(pose_a.positions, pose_b.positions);
    }
    expect_same(a.scenery.positions.floats(), b.scenery.positions.floats());
    EXPECT_EQ(a.origin, b.origin);
}

TEST(ScaleToUnit, UndoesPowersOfTwo) {
    for (const Precision precision : {Precision::f32, Precision::f16, Precision::i16}) {
        Model unit = make_model(precision);
        unit.origin = Vec3d(100, -3, 0);
        const Model original = unit;
        scale_to_unit(unit);
        float largest = 0.0f;
        for (size_t j = 0; j < unit.geometry.num_rows(); ++j) {
            const uint32_t plane = static_cast<uint32_t>(j / unit.geometry.num_points);
            largest = std::max(largest, unit.geometry.step(plane) * unit.geometry.mean[j]);
        }
        EXPECT_GE(largest, 1.0f);
        EXPECT_LT(largest, 2.0f);
        for (const int exponent : {-90, -70, -1, 1, 70, 90, 110}) {
            Model model = original;
            scale_model(model, exponent);
            scale_to_unit(model);
            expect_same_geometry(model, unit);
        }
    }
}

TEST(ScaleToUnit, IsThatOfEveryPrefix) {
    Model whole = make_model(Precision::f32);
    scale_model(whole, 77);
    Model prefix = first_components(whole, 0, 0);
    scale_to_unit(whole);
    scale_to_unit(prefix);
    EXPECT_TRUE(prefix.geometry.mean == whole.geometry.mean);  // to the bit
    EXPECT_TRUE(prefix.scenery.positions == whole.scenery.positions);
}

TEST(ScaleToUnit, TakesComponentsWhereTheMeanIsAPoint) {
    for (const Precision precision : {Precision::f32, Precision::i16}) {
        TestModelOptions options;
        options.precision = precision;
        Model model = make_test_model(options);
        LowRankMatrix& geometry = model.geometry;
        if (geometry.mean.holds_floats()) {
            geometry.mean = StoredValues(std::vector<float>(geometry.num_rows(), 0.0f));
        } else {
            geometry.mean = StoredValues(std::vector<int16_t>(geometry.num_rows(), 0));
        }
        scale_model(model, 90);
        scale_to_unit(model);
        // Three components of at most one times weights of at most 0.1 of a unit: their largest is
        // brought to 1 … 2, all together to 6 at most.
        const float size = sequence_bounds(model).diagonal();
        EXPECT_GT(size, 0.1f);
        EXPECT_LT(size, 2.0f * 6.0f * std::sqrt(3.0f));
    }
}

TEST(ScaleToUnit, LeavesSceneryFiniteAndPointsAlone) {
    Model model = make_model(Precision::f32);
    scale_model(model, -110);
    std::vector<float> positions(size_t{3} * model.scenery.topology.num_vertices, 3e38f);
    model.scenery.positions = StillPlanes(positions);
    scale_to_unit(model);
    for (const float x : model.scenery.positions.floats()) ASSERT_TRUE(std::isfinite(x));
    EXPECT_GT(sequence_bounds(model).diagonal(), 0.0f);

    Model point = first_components(make_test_model({}), 0, 5);
    point.geometry.mean = StoredValues(std::vector<float>(point.geometry.num_rows(), 0.0f));
    scale_to_unit(point);
    EXPECT_EQ(sequence_bounds(point).diagonal(), 0.0f);
}

// What a snapshot and the window draw from: the same camera and bounds, in one unit.
TEST(ScaleToUnit, IsAppliedToEveryFileThatIsLoaded) {
    const TemporaryDirectory directory;
    for (const bool prefix : {false, true}) {
        Frame frames[2];
        for (const int exponent : {0, -90}) {
            Model model = make_model(Precision::f32);
            scale_model(model, exponent);
            Options options;
            options.model_path = directory / "a.paim";
            options.play_prefix = prefix;
            options.camera = {1.0f, 0.5f, 3.0f};
            write_paim(options.model_path, model);
            const Scene scene = load_scene(options);
            frames[exponent == 0 ? 0 : 1] = first_frame(options, scene);
        }
        EXPECT_EQ(frames[0].camera.eye, frames[1].camera.eye);
        EXPECT_EQ(frames[0].camera.target, frames[1].camera.target);
        EXPECT_EQ(frames[0].bounds.lower, frames[1].bounds.lower);
        EXPECT_EQ(frames[0].bounds.upper, frames[1].bounds.upper);
        EXPECT_GT(frames[0].bounds.diagonal(), 1.0f);
    }
}

}  // namespace
}  // namespace paim::player
