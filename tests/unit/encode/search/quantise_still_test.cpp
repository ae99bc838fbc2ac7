// Still parts are within a target as well, and no finer than that.
#include "compressor/encode/search/quantise_still.h"

#include <gtest/gtest.h>

#include "compressor/encode/quantise/quantise.h"
#include "compressor/encode/search/target_encode.h"
#include "paim/base/error.h"
#include "paim/format/paim/paim_read.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {
namespace {

class QuantiseStill : public testing::Test {
  protected:
    QuantiseStill() { options_.precision = Precision::i16; }

    BakeReader bake(double still_noise) const {
        TargetBake numbers;
        numbers.still_noise = still_noise;
        return write_target_bake(directory_ / "x.bake", numbers);
    }

    // Reads the file again.
    Asset encode(const BakeReader& bake, double error) const {
        EncodeTarget target;
        target.transfer_error = error;
        target.spectrum = BandPower::flat(4);
        encode_to_target(bake, options_, target, output_);
        return read_paim(output_);
    }

    const TemporaryDirectory directory_;
    const std::filesystem::path output_ = directory_ / "x.paim";
    EncodeOptions options_;
};

TEST_F(QuantiseStill, IsAsCoarseAsTheTargetAllows) {
    const BakeReader bake = this->bake(0.001);
    for (const double error : {0.1, 0.02}) {
        const Asset asset = encode(bake, error);
        ASSERT_NE(asset.still(), nullptr);
        EXPECT_FALSE(asset.still()->transfer->matrix.holds_floats());
        EXPECT_FALSE(asset.still()->positions.holds_floats());
        const AssetError measured = measure_asset(asset, bake, BandPower::flat(4));
        // Steps end within 0.5 % of the largest that are good, and errors of rounding are those of
        // 6400 and 1200 values.
        EXPECT_LE(measured.still->transfer.total(), error);
        EXPECT_GT(measured.still->transfer.total(), 0.93 * error);
        // Relative to the diagonal of the moving part; the diagonal of the still part is twice as
        // long.
        const double distance = error * kGeometryPerTransferError * measured.geometry.diagonal;
        EXPECT_LE(measured.still->geometry.rms(), distance * (1.0 + 1e-6));
        EXPECT_GT(measured.still->geometry.rms(), 0.9 * distance);
        const ErrorStatement stated = read_error_statement(asset, output_);
        EXPECT_EQ(stated.errors.back().name, "scenery_position_worst");
        EXPECT_EQ(stated.errors.back().value, measured.still->geometry.worst());
    }
}

TEST_F(QuantiseStill, IsWithinTheTargetWithNoiseOfItsOwn) {
    const BakeReader bake = this->bake(0.02);
    const Asset asset = encode(bake, 0.08);
    const AssetError measured = measure_asset(asset, bake, BandPower::flat(4));
    EXPECT_GT(measured.still->transfer.bake_noise, 0.02);
    EXPECT_LE(measured.still->transfer.total(), 0.08);
    EXPECT_GT(measured.still->transfer.total(), 0.07);
}

// Steps are chosen by a sum in steps. Floats round what is decoded once more, by up to 2^-24 · 2^15
// of a fine step, which may be too much. Targets just below an error that was measured, but not
// below what the sum says of the same steps, are such that the first steps are too coarse.
TEST_F(QuantiseStill, IsMadeFinerWhereMeasuringFindsItTooCoarse) {
    const BakeReader bake = this->bake(0.0);
    EncodeTarget target;
    target.transfer_error = 0.02;
    target.spectrum = BandPower::flat(4);
    const EncodeProblem problem = read_problem(bake, options_, target);
    const CodedMesh exact = *exact_still(problem).mesh;
    const auto mean_of = [&](const LowRank& matrix) {
        ScaledFactors factors;
        factors.num_points = exact.topology.num_vertices;
        factors.num_planes = matrix.num_planes;
        factors.mean = matrix.mean_floats();
        factors.weights.resize(0, 1);  // one pose
        return factors;
    };
    const ScaledFactors transfer = mean_of(exact.transfer->matrix);
    const ScaledFactors positions = mean_of(exact.positions);
    double energy = 0.0;
    for (const float t : transfer.mean) energy += double{t} * double{t};
    uint32_t num_transfers = 0, num_positions = 0;
    for (double error = 1e-4; error < 1e-3; error *= 1.2) {
        const double distance = error;
        constexpr double kAny = 1e9;
        // Edges, normals and single vertices may be what they are.
        const QuantisedStill first = quantise_still(problem, {error, kAny, {distance, 1.0, 180.0}});
        EXPECT_LE(first.error->transfer.total(), error);
        EXPECT_LE(first.error->geometry.rms(), distance);
        const double less = first.error->transfer.total() * (1.0 - 1e-8);
        const double nearer = first.error->geometry.rms() * (1.0 - 1e-8);
        const QuantisedStill second = quantise_still(problem, {less, kAny, {nearer, 1.0, 180.0}});
        EXPECT_LE(second.error->transfer.total(), less);
        EXPECT_LE(second.error->geometry.rms(), nearer);
        const auto sum_of = [](const ScaledFactors& factors, const LowRank& matrix) {
            const std::vector<double> alike(factors.num_planes, 1.0);
            return quantised_error(factors, {double{matrix.steps[0]}, 0, alike});
        };
        num_transfers += sum_of(transfer, first.mesh->transfer->matrix) < less * less * energy;
        num_positions += sum_of(positions, first.mesh->positions) <
                         nearer * nearer * exact.topology.num_vertices;
    }
    EXPECT_GT(num_transfers, 0u) << "else this would not say much";
    EXPECT_GT(num_positions, 0u) << "else this would not say much";
}

TEST_F(QuantiseStill, IsRefusedByNameWhereItsNoiseIsTooLarge) {
    const BakeReader bake = this->bake(0.1);
    try {
        encode(bake, 0.02);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::threshold_exceeded);
        EXPECT_NE(std::string(error.what()).find("in the still meshes the bake's noise leaves"),
                  std::string::npos)
            << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(output_));
}

// Floats stay what they are, in the order that the animation has.
TEST_F(QuantiseStill, LeavesFloatsAsTheyAre) {
    options_.precision = Precision::f32;
    const BakeReader bake = this->bake(0.001);
    const AssetError measured = measure_asset(encode(bake, 0.02), bake, BandPower::flat(4));
    EXPECT_EQ(measured.still->geometry.worst(), 0.0);
    EXPECT_EQ(measured.still->transfer.error_to_bake, 0.0);
}

}  // namespace
}  // namespace paim
