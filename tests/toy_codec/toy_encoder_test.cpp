// A search tries a codec that nobody outside this folder knows, adds up its memory, measures its
// files and reports its numbers.
#include <gtest/gtest.h>

#include <algorithm>

#include "compressor/encode/search/target_encode.h"
#include "compressor/target_report.h"
#include "paim/base/error.h"
#include "paim/format/paim/paim_read.h"
#include "tests/temporary_directory.h"
#include "tests/toy_codec/shared_points.h"
#include "tests/toy_codec/shared_points_encoder.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {
namespace {

using toy::SharedPoints;

class ToyEncoder : public testing::Test {
  protected:
    // Once, however often the tests are repeated.
    static void SetUpTestSuite() {
        static const bool added = [] {
            add_transfer_codec(toy::codec());
            add_transfer_encoder(toy::encoder_type());
            return true;
        }();
        ASSERT_TRUE(added);
    }

    ToyEncoder() {
        options_.precision = Precision::i16;
        target_.transfer_error = 0.02;
        target_.spectrum = BandPower::flat(4);
    }

    TargetSummary encode(const std::string& codec) {
        target_.codec = codec;
        return encode_to_target(bake_, options_, target_, output_);
    }

    std::string refusal(const std::string& codec) {
        try {
            encode(codec);
        } catch (const Error& error) {
            return error.what();
        }
        return "not refused";
    }

    const TemporaryDirectory directory_;
    const BakeReader bake_ = write_target_bake(directory_ / "x.bake");
    const std::filesystem::path output_ = directory_ / "x.paim";
    EncodeOptions options_;
    EncodeTarget target_;
};

TEST_F(ToyEncoder, IsChosenWhereItIsAskedFor) {
    const TargetSummary summary = encode(std::string(SharedPoints::kName));
    EXPECT_EQ(summary.chosen().codec, SharedPoints::kName);
    EXPECT_EQ(summary.candidates.size(), 1u);
    EXPECT_LE(summary.error.transfer.total(), 0.02);
    const Asset asset = read_paim(output_);
    ASSERT_NE(asset.moving().transfer.as<SharedPoints>(), nullptr);
    EXPECT_EQ(asset.moving().transfer.as<SharedPoints>()->num_shared, 400u);
    EXPECT_EQ(measure_asset(asset, bake_, target_.spectrum).transfer.total(),
              summary.error.transfer.total());
}

TEST_F(ToyEncoder, IsTriedBesideTheOthers) {
    const TargetSummary summary = encode("auto");
    for (const std::string_view codec : {"svd", "cpca", "shared-points"}) {
        EXPECT_TRUE(std::any_of(summary.candidates.begin(), summary.candidates.end(),
                                [&](const Candidate& one) { return one.codec == codec; }))
            << codec;
    }
}

TEST_F(ToyEncoder, IsReportedWithNumbersOfItsOwn) {
    const TargetReport report{output_, encode("auto")};
    const std::string text = report_text(report);
    EXPECT_NE(text.find("components  clusters x components  shared points  transfer kB"),
              std::string::npos)
        << text;
    for (const auto& candidate : report_json(report)["candidates"]) {
        EXPECT_EQ(candidate["shared_points"], candidate["codec"] == "shared-points" ? 400 : 0);
        EXPECT_EQ(candidate["clusters"] > 0, candidate["codec"] == "cpca");
    }
    const TargetReport own{output_, encode("shared-points")};
    EXPECT_EQ(report_json(own)["shared_points"], 400);
    EXPECT_FALSE(report_json(own).contains("clusters"));
}

TEST_F(ToyEncoder, CountsItsMemory) {
    options_.memory_bytes = toy::kKeptBytes;
    EXPECT_NE(refusal("shared-points").find("(--codec svd alone takes"), std::string::npos);
    EXPECT_EQ(refusal("svd"), "not refused");
}

// An error below what values of 16 bits leave.
TEST_F(ToyEncoder, SaysWhyAnErrorIsNotMet) {
    std::filesystem::remove_all(directory_ / "x.bake");
    const BakeReader exact = write_target_bake(directory_ / "x.bake", {.noise = 0.0});
    target_.transfer_error = 1e-6;
    target_.geometry_error = 1e-3;
    target_.codec = SharedPoints::kName;
    try {
        encode_to_target(exact, options_, target_, output_);
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::threshold_exceeded);
        EXPECT_NE(std::string(error.what()).find("cannot be met by toys"), std::string::npos)
            << error.what();
    }
}

TEST_F(ToyEncoder, IsNamedAmongTheCodecsThatThereAre) {
    EXPECT_NE(refusal("wavelet").find("one of auto, svd, cpca, shared-points, got 'wavelet'"),
              std::string::npos);
}

}  // namespace
}  // namespace paim
