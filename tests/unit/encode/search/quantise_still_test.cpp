// What stands still is within a target as well, and no finer than that.
#include "compressor/encode/search/quantise_still.h"

#include <gtest/gtest.h>

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
        // Of the diagonal of what moves, not of what stands still, which is twice as long.
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

TEST_F(QuantiseStill, IsRefusedByNameWhereItsNoiseIsTooLarge) {
    const BakeReader bake = this->bake(0.1);
    try {
        encode(bake, 0.02);
        ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::threshold_exceeded);
        EXPECT_NE(std::string(error.what()).find("of the scenery the bake's noise leaves"),
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
    EXPECT_EQ(measured.still->transfer.deviation, 0.0);
}

}  // namespace
}  // namespace paim
