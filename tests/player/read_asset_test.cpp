// Assets of every size are read as of one size.
#include "player/read_asset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/codec/rebuild_planes.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/codec/svd/svd_transfer.h"
#include "paim/format/paim/paim_write.h"
#include "player/scene.h"
#include "player/view/framing.h"
#include "tests/first_components.h"
#include "tests/player/test_asset.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

// With a still part that reaches ten times as far.
Asset make_asset(Precision precision) {
    TestAssetOptions options;
    options.precision = precision;
    Asset asset = make_test_asset(options);
    CodedMesh still;
    still.topology = asset.moving().topology;
    still.albedo = asset.moving().albedo;
    still.layout = asset.moving().layout;
    std::vector<float> positions = make_test_asset({}).moving().positions.mean.floats();
    for (float& x : positions) x *= 10.0f;
    if (is_integer(precision)) {
        std::vector<int16_t> integers;
        for (const float x : positions) {
            integers.push_back(static_cast<int16_t>(std::lround(1000.0f * x)));
        }
        still.positions = LowRank::still(3, std::move(integers), {1e-3f, 1e-3f, 1e-3f});
    } else {
        still.positions = LowRank::still(3, std::move(positions));
    }
    const uint32_t num_planes = still.layout.num_planes();
    const size_t num_values = size_t{num_planes} * still.topology.num_vertices;
    still.transfer = SvdTransfer(LowRank::still(num_planes, std::vector<float>(num_values, 0.1f)));
    asset.parts.push_back(std::move(still));
    return asset;
}

// Coordinates near zero may have lost digits where they were scaled down: they were rounded to
// 2^-149 at 2^-90 of their size, and all that is added up has fewer than eight terms.
void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t j = 0; j < a.size(); ++j) ASSERT_NEAR(a[j], b[j], 8.0 * 0x1p-59) << j;
}

// With all components. [3][V]
std::vector<float> positions_at(const LowRank& matrix, double time) {
    std::vector<float> positions;
    PositionDecoder().decode(matrix, time, matrix.num_components, positions);
    return positions;
}

void expect_same_positions(const Asset& a, const Asset& b) {
    for (const double time : {0.0, 2.5}) {
        expect_same(positions_at(a.moving().positions, time),
                    positions_at(b.moving().positions, time));
    }
    expect_same(a.still()->positions.mean_floats(), b.still()->positions.mean_floats());
    EXPECT_EQ(a.origin, b.origin);
}

TEST(ScaleToUnit, UndoesPowersOfTwo) {
    for (const Precision precision : {Precision::f32, Precision::f16, Precision::i16}) {
        Asset unit = make_asset(precision);
        unit.origin = Vec3d(100, -3, 0);
        const Asset original = unit;
        scale_to_unit(unit);
        const std::vector<float> mean = unit.moving().positions.mean_floats();
        const float largest = *std::max_element(mean.begin(), mean.end());
        EXPECT_GE(largest, 1.0f);
        EXPECT_LT(largest, 2.0f);
        for (const int exponent : {-90, -70, -1, 1, 70, 90, 110}) {
            Asset asset = original;
            scale_asset(asset, exponent);
            scale_to_unit(asset);
            expect_same_positions(asset, unit);
        }
    }
}

TEST(ScaleToUnit, IsThatOfEveryPrefix) {
    Asset whole = make_asset(Precision::f32);
    scale_asset(whole, 77);
    Asset prefix = first_components(whole, 0, 0);
    scale_to_unit(whole);
    scale_to_unit(prefix);
    EXPECT_TRUE(prefix.moving().positions.mean == whole.moving().positions.mean);  // to the bit
    EXPECT_TRUE(prefix.still()->positions == whole.still()->positions);
}

TEST(ScaleToUnit, TakesComponentsWhereTheMeanIsAPoint) {
    for (const Precision precision : {Precision::f32, Precision::i16}) {
        TestAssetOptions options;
        options.precision = precision;
        Asset asset = make_test_asset(options);
        LowRank& geometry = asset.moving().positions;
        if (geometry.mean.holds_floats()) {
            geometry.mean = StoredValues(std::vector<float>(geometry.num_rows(), 0.0f));
        } else {
            geometry.mean = StoredValues(std::vector<int16_t>(geometry.num_rows(), 0));
        }
        scale_asset(asset, 90);
        scale_to_unit(asset);
        // Three components of at most one times weights of at most 0.1 of a unit: their largest is
        // brought to 1 … 2, all together to 6 at most.
        const float size = sequence_bounds(asset).diagonal();
        EXPECT_GT(size, 0.1f);
        EXPECT_LT(size, 2.0f * 6.0f * std::sqrt(3.0f));
    }
}

TEST(ScaleToUnit, LeavesStillPartsFiniteAndPointsAlone) {
    Asset asset = make_asset(Precision::f32);
    scale_asset(asset, -110);
    LowRank& still = asset.still()->positions;
    still = LowRank::still(3, std::vector<float>(still.num_rows(), 3e38f));
    scale_to_unit(asset);
    for (const float x : still.mean_floats()) ASSERT_TRUE(std::isfinite(x));
    EXPECT_GT(sequence_bounds(asset).diagonal(), 0.0f);

    Asset point = first_components(make_test_asset({}), 0, 5);
    LowRank& geometry = point.moving().positions;
    geometry.mean = StoredValues(std::vector<float>(geometry.num_rows(), 0.0f));
    scale_to_unit(point);
    EXPECT_EQ(sequence_bounds(point).diagonal(), 0.0f);
}

// A path that is many times longer than the body, and an exception (codec/low_rank.h) far away.
TEST(ScaleToUnit, LeavesPathsAndExceptionsFinite) {
    Asset asset = make_test_asset({});
    scale_asset(asset, -100);
    CodedMesh& mesh = asset.moving();
    mesh.root_motion.resize(asset.num_poses());
    mesh.root_motion.back().translation = Vec3d(0x1p40, 0, 0);
    mesh.positions.weights.back() = 1e32f;
    mesh.positions.singular_values.back() = 0.0;
    scale_to_unit(asset);
    EXPECT_TRUE(sequence_bounds(asset).upper.allFinite());
    EXPECT_GT(sequence_bounds(asset).upper.x(), 1.0f);
    EXPECT_TRUE(std::isfinite(mesh.positions.weights.back()));
}

// What a snapshot and the window draw from: the same camera and bounds, in one unit.
TEST(ScaleToUnit, IsAppliedToEveryFileThatIsLoaded) {
    const TemporaryDirectory directory;
    for (const bool prefix : {false, true}) {
        Camera cameras[2];
        Bounds bounds[2];
        for (const int exponent : {0, -90}) {
            Asset asset = make_asset(Precision::f32);
            scale_asset(asset, exponent);
            Options options;
            options.model_path = directory / "a.paim";
            options.play_prefix = prefix;
            write_paim(options.model_path, asset);
            const Scene scene = load_scene(options);
            const size_t which = exponent == 0 ? 0 : 1;
            cameras[which] = frame_asset(*scene.asset, 1.0f, 0.5f, 1.5f);
            bounds[which] = pose_bounds(*scene.asset, 0.0, 100);
            // Scene units are those of the file.
            const Bounds in_file = pose_bounds(asset, 0.0, 100);
            EXPECT_EQ(scene.units.to_scene(bounds[which].upper.cast<double>()),
                      in_file.upper.cast<double>());
            EXPECT_EQ(scene.units.to_model(in_file.upper.cast<double>()),
                      bounds[which].upper.cast<double>());
        }
        EXPECT_EQ(cameras[0].eye, cameras[1].eye);
        EXPECT_EQ(cameras[0].target, cameras[1].target);
        EXPECT_EQ(bounds[0].lower, bounds[1].lower);
        EXPECT_EQ(bounds[0].upper, bounds[1].upper);
        EXPECT_GT(bounds[0].diagonal(), 1.0f);
    }
}

}  // namespace
}  // namespace paim::player
