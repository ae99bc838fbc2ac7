// Error curves by theory against norms and sizes that are computed apart.
#include "analysis/curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "paim/codec/cut.h"
#include "paim/format/paim/paim_write.h"
#include "tests/example_asset.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {
namespace {

constexpr uint32_t kBands = 4, kChannels = 3, kPoses = 5;

class Curves : public testing::Test {
  protected:
    Curves()
        : bake_(write_target_bake(directory_ / "x.bake",
                                  {.layout = {TransferKind::diffuse, kBands, kChannels},
                                   .width = 4,
                                   .num_poses = kPoses})) {}

    // √ of the sum of squares of coefficient i over vertices, channels and poses, [B²].
    std::vector<double> norms() const {
        std::vector<double> squares(kBands * kBands, 0.0);
        for (uint32_t p = 0; p < kPoses; ++p) {
            const BakedPose pose = bake_.read_pose(p);
            const size_t num_vertices = bake_.identity().num_vertices;
            for (size_t n = 0; n < pose.transfer.size(); ++n) {
                const double t = pose.transfer[n];
                squares[n / num_vertices % squares.size()] += t * t;
            }
        }
        for (double& value : squares) value = std::sqrt(value);
        return squares;
    }

    const TemporaryDirectory directory_;
    const BakeReader bake_;
};

TEST_F(Curves, NormsAreThoseOfCoefficients) {
    const std::vector<double> expected = norms();
    const std::vector<double> got = coefficient_norms(bake_);
    ASSERT_EQ(got.size(), expected.size());
    // Sums of 240 squares in another order.
    for (size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i] / expected[i], 1.0, 1e-13) << i;
}

TEST_F(Curves, OfBandsLoseTheCoefficientsFromBSquaredOn) {
    const Asset asset = make_example_asset(kBands, kChannels, kPoses);
    const std::vector<double> norms = this->norms();
    const auto sum_from = [&](size_t first, int power) {
        return std::accumulate(
            norms.begin() + static_cast<ptrdiff_t>(first), norms.end(), 0.0,
            [&](double sum, double norm) { return sum + std::pow(norm, power); });
    };
    const Curve bands = plan_curves(bake_, asset, {}, {1, 3, 7}).back();
    EXPECT_EQ(bands.name, "bands");
    ASSERT_EQ(bands.theory_errors.size(), kBands + 1);
    ASSERT_EQ(bands.energy_errors.size(), kBands + 1);
    for (uint32_t b = 0; b <= kBands; ++b) {
        const double theory = sum_from(b * b, 1) / sum_from(0, 1);
        const double energy = std::sqrt(sum_from(b * b, 2) / sum_from(0, 2));
        // Sums of 16 numbers in another order.
        EXPECT_NEAR(bands.theory_errors[b], theory, 1e-13) << b;
        EXPECT_NEAR(bands.energy_errors[b], energy, 1e-13) << b;
    }
    // All, then those that are fewer and were asked for; each with the errors of its value and the
    // size of a file that has no more bands.
    ASSERT_EQ(bands.points.size(), 3u);
    const std::vector<uint32_t> expected{kBands, 3, 1};
    for (size_t j = 0; j < bands.points.size(); ++j) {
        const CurvePoint& point = bands.points[j];
        EXPECT_EQ(point.value, expected[j]);
        EXPECT_EQ(point.all, j == 0);
        EXPECT_EQ(point.limits.bands, expected[j]);
        EXPECT_EQ(point.theory_error, bands.theory_errors[point.value]);
        EXPECT_EQ(point.energy_error, bands.energy_errors[point.value]);
        EXPECT_EQ(point.size_bytes,
                  paim_size_bytes(make_example_asset(point.value, kChannels, kPoses)));
    }
}

TEST_F(Curves, OfComponentsLoseTheSingularValuesFromKOn) {
    const Asset asset = make_example_asset(kBands, kChannels, kPoses, 3);
    const std::vector<Curve> curves = plan_curves(bake_, asset, {2, 1, 9}, {});
    ASSERT_EQ(curves.size(), 3u);
    EXPECT_EQ(num_points(curves), 3u + 3u + 1u);
    // Singular values 1, 1/2, 1/4 times a number: dropped of 7/4, and of 21/16.
    const double theory[4] = {1.0, 3.0 / 7.0, 1.0 / 7.0, 0.0};
    const double energy[4] = {1.0, std::sqrt(5.0 / 21.0), std::sqrt(1.0 / 21.0), 0.0};
    for (size_t c = 0; c < 2; ++c) {
        EXPECT_EQ(curves[c].name, c == 0 ? "geometry_components" : "transfer_components");
        const uint32_t expected[3] = {3, 2, 1};
        for (size_t j = 0; j < 3; ++j) {
            const CurvePoint& point = curves[c].points[j];
            const uint32_t k = expected[j];
            EXPECT_EQ(point.value, k);
            EXPECT_NEAR(point.theory_error, theory[k], 1e-15);
            EXPECT_NEAR(point.energy_error, energy[k], 1e-15);
            // Only one of the two is limited.
            const DecodeLimits all;
            EXPECT_EQ(point.limits.geometry_components, c == 0 ? k : all.geometry_components);
            EXPECT_EQ(point.limits.transfer_components, c == 1 ? k : all.transfer_components);
            EXPECT_EQ(point.limits.bands, all.bands);
        }
        EXPECT_NEAR(curves[c].theory_errors[0], 1.0, 1e-15);
        EXPECT_EQ(curves[c].theory_errors.size(), 4u);
    }
}

// Bytes are those of the whole file, with everything else kept: the still part in as many bands,
// and the origin.
TEST_F(Curves, SizesCountWhatStandsStill) {
    Asset asset = make_example_asset(kBands, kChannels, kPoses);
    asset.parts.push_back(make_example_still(asset.moving().layout));
    asset.origin = Vec3d(1e6, 0.0, 0.0);
    for (const Curve& curve : plan_curves(bake_, asset, {1}, {1})) {
        for (const CurvePoint& point : curve.points) {
            Asset limited = asset;
            for (CodedMesh& mesh : limited.parts) keep_bands(mesh, point.limits.bands);
            limited.moving().positions.keep_components(point.limits.geometry_components);
            limited.moving().transfer->matrix.keep_components(point.limits.transfer_components);
            write_paim(directory_ / "x.paim", limited);
            EXPECT_EQ(point.size_bytes, std::filesystem::file_size(directory_ / "x.paim"))
                << curve.name << " " << point.value;
        }
    }
}

}  // namespace
}  // namespace paim
