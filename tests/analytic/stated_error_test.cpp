// Errors that files of a noisy bake state, against those to a bake of many rays.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/search/target_encode.h"
#include "paim/format/paim/paim_read.h"
#include "paim/metrics/asset_error.h"
#include "poses/octopus.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kBands = 5;

class StatedError : public testing::Test {
  protected:
    static constexpr uint32_t kNumPoses = 6;

    StatedError() {
        const PoseSet octopus = poses::make_octopus(2000, kNumPoses);
        const auto bake = [&](const char* name, uint32_t rays, uint64_t seed) {
            bake_sequence(octopus, {kBands, rays, seed}, "faces", directory_ / name, 0,
                          kNumPoses - 1, [](uint32_t) {});
        };
        bake("noisy.bake", 128, 1);
        bake("truth.bake", 2048, 77);
    }

    void encode(const BakeReader& bake, const std::string& codec, double error) const {
        EncodeOptions options;
        options.precision = Precision::i16;
        EncodeTarget target;
        target.codec = codec;
        target.transfer_error = error;
        target.spectrum = flat_;
        encode_to_target(bake, options, target, file_);
    }

    const TemporaryDirectory directory_;
    const std::filesystem::path file_ = directory_ / "x.paim";
    const BandPower flat_ = BandPower::flat(kBands);
};

// The bake has 3.6 % of noise, so that nearly all of an error of 4 % is noise, and little of one of 8 %.
TEST_F(StatedError, IsWithinThreePercentOfTheTrueOne) {
    const BakeReader bake(directory_ / "noisy.bake"), truth(directory_ / "truth.bake");
    for (const char* const codec : {"svd", "cpca"}) {
        for (const double error : {0.04, 0.05, 0.08}) {
            encode(bake, codec, error);
            const Asset asset = read_paim(file_);
            const TransferError to_bake = measure_asset(asset, bake, flat_).transfer;
            const TransferError to_truth = measure_asset(asset, truth, flat_).transfer;
            double stated = 0.0, true_energy = 0.0;
            for (uint32_t l = 0; l < kBands; ++l) {
                stated += to_bake.bands[l].expected();
                // The noise of the other bake is known.
                true_energy += to_truth.bands[l].error_to_bake - to_truth.bands[l].noise;
            }
            EXPECT_NEAR(std::sqrt(stated / true_energy), 1.0, 0.03) << codec << " " << error;
        }
    }
}

TEST_F(StatedError, LargerOnesTakeFewerBytes) {
    const BakeReader bake(directory_ / "noisy.bake");
    uintmax_t before = std::numeric_limits<uintmax_t>::max();
    for (const double error : {0.038, 0.04, 0.045, 0.05, 0.06, 0.08}) {
        encode(bake, "auto", error);
        const uintmax_t bytes = std::filesystem::file_size(file_);
        EXPECT_LT(bytes, before) << error;
        before = bytes;
    }
}

}  // namespace
}  // namespace paim
