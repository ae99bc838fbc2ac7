// From an error to a file: targets that are refused, and what is said of them.
#include "compressor/encode/search/target_encode.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "compressor/encode/memory/memory_plan.h"
#include "compressor/encode/search/encoded_file.h"
#include "compressor/encode/search/problem.h"
#include "paim/base/error.h"
#include "tests/unit/encode/search/target_encode_fixture.h"

namespace paim {
namespace {

class TargetRefusals : public TargetEncode {};

TEST_F(TargetRefusals, RefusesBakesThatAreTooNoisy) {
    const BakeReader bake = this->bake({.noise = 0.3});
    expect_refused(bake, target(bake, 0.01), ExitCode::threshold_exceeded, "noise leaves");
    expect_refused(bake, target(bake, 0.01), ExitCode::threshold_exceeded, "% at best");
}

TEST_F(TargetRefusals, RefusesTooFewBands) {
    const BakeReader bake = this->bake({.noise = 0.0});
    options_.bands = 2;
    expect_refused(bake, target(bake, 0.01), ExitCode::threshold_exceeded,
                   "2 of its 4 bands leave");
    options_.bands = 4;
    EncodeTarget natural = target(bake, 0.01);
    natural.spectrum = BandPower::natural();
    expect_refused(bake, natural, ExitCode::threshold_exceeded, "its 4 bands leave out");
}

TEST_F(TargetRefusals, RefusesDecodeCostsThatCannotBe) {
    const BakeReader bake = this->bake();
    EncodeTarget cheap = target(bake, 0.01);
    cheap.decode_cost = 2;
    expect_refused(bake, cheap, ExitCode::threshold_exceeded, "with 2 multiply-adds a vertex");
    // Three channels of a mean and some components of a cluster.
    cheap.transfer_error = 0.05;
    cheap.decode_cost = 40;
    const TargetSummary summary = encode(bake, cheap);
    EXPECT_LE(summary.chosen().multiply_adds, 40u);
    EXPECT_EQ(summary.chosen().codec, "cpca");
}

TEST_F(TargetRefusals, RefusesCodecsThatThereAreNot) {
    const BakeReader bake = this->bake();
    for (const Precision precision : {Precision::i16, Precision::f32}) {
        options_.precision = precision;
        expect_refused(bake, target(bake, 0.02, "wavelet"), ExitCode::usage,
                       "codec: expected one of auto, svd, cpca, got 'wavelet'");
    }
}

TEST_F(TargetRefusals, RefusesFloatsOfCodecsOfIntegers) {
    const BakeReader bake = this->bake();
    for (const Precision precision : {Precision::f32, Precision::f16}) {
        options_.precision = precision;
        expect_refused(bake, target(bake, 0.02, "cpca"), ExitCode::usage,
                       "codec cpca: codes integers alone: expected --precision auto, got floats");
    }
}

TEST_F(TargetRefusals, RefusesSizesThatCannotBe) {
    const BakeReader bake = this->bake();
    EncodeTarget small = target(bake, 0.02);
    small.size_bytes = 1000;
    expect_refused(bake, small, ExitCode::threshold_exceeded, "--max-size allows 1000");
    small.transfer_error.reset();
    expect_refused(bake, small, ExitCode::threshold_exceeded, "--max-size asks for 1000 bytes");
}

// Whatever size is asked for: noise is what stands in the way.
TEST_F(TargetRefusals, RefusesSizesOfBakesThatAreNoise) {
    const BakeReader bake = this->bake({.num_poses = 1, .noise = 30.0});
    EncodeTarget any = target(bake, 0.02);
    any.transfer_error.reset();
    any.size_bytes = 1'000'000'000;
    expect_refused(bake, any, ExitCode::threshold_exceeded, "noise leaves");
}

// Floats that are chosen by an estimate may need a component more once they are measured, and with
// it more than the decode cost that was asked for. The first target that an estimate meets with one
// component fewer is where that happens, if anywhere.
TEST_F(TargetRefusals, RefusesDecodeCostsThatOnlyEstimatesMeet) {
    const BakeReader bake = this->bake({.noise = 0.02});
    options_.precision = Precision::f32;
    EncodeTarget costly = target(bake, 0.05);
    const EncodeProblem problem = read_problem(bake, options_, costly);
    SearchMemo memo(problem, options_.precision);
    EncodedFiles files(problem, options_, costly, memo);
    uint32_t num_found = 0, estimated_before = 0;
    for (double error = 1.01 * problem.least_error(); error < 0.5; error *= 1.002) {
        std::string reason;
        const auto draft = files.draft(error, reason);
        ASSERT_TRUE(draft) << reason;
        const uint32_t estimated = draft->candidates.at(0).multiply_adds;
        if (std::exchange(estimated_before, estimated) == estimated) continue;
        const auto file = files.meet(error, reason);
        ASSERT_TRUE(file) << reason;
        const uint32_t measured = file->candidates.at(0).multiply_adds;
        if (measured == estimated) continue;
        ++num_found;
        EXPECT_GT(measured, estimated);
        costly.transfer_error = error;
        costly.decode_cost = estimated;
        expect_refused(bake, costly, ExitCode::threshold_exceeded,
                       fmt::format("takes {} multiply-adds a vertex, --max-decode-cost allows {}",
                                   measured, estimated));
        costly.decode_cost = measured;
        EXPECT_EQ(encode(bake, costly).chosen().multiply_adds, measured);
        std::filesystem::remove(output_);
        costly.decode_cost.reset();
    }
    EXPECT_GT(num_found, 0u) << "else this would not say much";
}

TEST_F(TargetRefusals, RefusesMemoryThatDoesNotSuffice) {
    const BakeReader bake = this->bake();
    // Enough for rows that are streamed.
    options_.memory_bytes = encode_memory_bytes(encode_size(bake, options_), 1);
    expect_refused(bake, target(bake, 0.01), ExitCode::unsupported, "components in memory, need");
    options_.memory_bytes = 1'000'000;
    expect_refused(bake, target(bake, 0.01), ExitCode::unsupported, "but --memory allows 1 MB");
}

}  // namespace
}  // namespace paim
