// Bakes and targets to encode them to, in a directory of their own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "compressor/encode/search/target_encode.h"
#include "paim/base/error.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {

class TargetEncode : public testing::Test {
  protected:
    TargetEncode() { options_.precision = Precision::i16; }

    BakeReader bake(const TargetBake& numbers = {}) const {
        return write_target_bake(directory_ / "x.bake", numbers);
    }

    EncodeTarget target(const BakeReader& bake, double error, const std::string& codec = "") const {
        EncodeTarget target;
        target.transfer_error = error;
        target.codec = codec;
        target.spectrum = BandPower::flat(bake.identity().layout.in_bands);
        return target;
    }

    TargetSummary encode(const BakeReader& bake, const EncodeTarget& target) const {
        return encode_to_target(bake, options_, target, output_);
    }

    void expect_refused(const BakeReader& bake, const EncodeTarget& target, ExitCode code,
                        const std::string& words) const {
        try {
            encode(bake, target);
            ADD_FAILURE() << "not refused";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
        EXPECT_FALSE(std::filesystem::exists(output_));
    }

    const TemporaryDirectory directory_;
    const std::filesystem::path output_ = directory_ / "x.paim";
    EncodeOptions options_;
};

}  // namespace paim
