// Ways to code a transfer: all meet the error, and the best is the best of all.
#include "compressor/encode/search/transfer_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paim/base/seed.h"
#include "tests/temporary_directory.h"
#include "tests/unit/encode/search/target_bake.h"

namespace paim {
namespace {

TransferCoding coding(uint64_t bytes, uint32_t multiply_adds) {
    TransferCoding coding;
    coding.candidate.bytes = bytes;
    coding.candidate.multiply_adds = multiply_adds;
    return coding;
}

TEST(BestCoding, IsTheSmallestOrThatOfAPercentMoreWhichPlaysFaster) {
    const std::vector<TransferCoding> codings{coding(1010, 30), coding(1000, 50), coding(1005, 40),
                                              coding(1011, 10), coding(1400, 5)};
    EXPECT_EQ(best_coding(codings, Preference::size), &codings[0]);
    EXPECT_EQ(best_coding(codings, Preference::speed), &codings[4]);
    EXPECT_EQ(best_coding({}, Preference::size), nullptr);
}

TEST(BestCoding, IsNotLargerThanAllowed) {
    const std::vector<TransferCoding> codings{coding(1010, 30), coding(1000, 50), coding(1005, 40)};
    EXPECT_EQ(best_coding(codings, Preference::size, {1009}), &codings[2]);
    EXPECT_EQ(best_coding(codings, Preference::size, {1000}), &codings[1]);
    EXPECT_EQ(best_coding(codings, Preference::speed, {1009}), &codings[2]);
    for (const Preference preference : {Preference::size, Preference::speed}) {
        EXPECT_EQ(best_coding(codings, preference, {999}), nullptr);
    }
}

TEST(BestCoding, IsAsCheapAsAllowedWhereAnyIs) {
    const std::vector<TransferCoding> codings{coding(1000, 50), coding(1200, 30), coding(1100, 40)};
    EXPECT_EQ(best_coding(codings, Preference::size, {{}, 50}), &codings[0]);
    EXPECT_EQ(best_coding(codings, Preference::size, {{}, 49}), &codings[2]);
    EXPECT_EQ(best_coding(codings, Preference::size, {{}, 39}), &codings[1]);
    EXPECT_EQ(best_coding(codings, Preference::size, {{}, 29}), &codings[0]);
    // Those within the bytes are asked first.
    EXPECT_EQ(best_coding(codings, Preference::size, {1150, 39}), &codings[0]);
}

// By the definition, on numbers of which many are equal or within a percent.
TEST(BestCoding, IsTheBestOfAllByDefinition) {
    RandomStream random(4);
    for (int round = 0; round < 200; ++round) {
        std::vector<TransferCoding> codings;
        const auto count = 1 + static_cast<size_t>(random.uniform() * 8);
        while (codings.size() < count) {
            codings.push_back(coding(1000 + static_cast<uint64_t>(random.uniform() * 30),
                                     1 + static_cast<uint32_t>(random.uniform() * 4)));
        }
        const uint64_t most = 1000 + static_cast<uint64_t>(random.uniform() * 30);
        uint64_t fewest = most;
        for (const TransferCoding& one : codings) fewest = std::min(fewest, one.candidate.bytes);
        for (const Preference preference : {Preference::size, Preference::speed}) {
            const uint64_t limit =
                preference == Preference::size ? std::min(most, fewest + fewest / 100) : most;
            const TransferCoding* best = best_coding(codings, preference, {most});
            const auto allowed = [&](const TransferCoding& one) {
                return one.candidate.bytes <= limit;
            };
            ASSERT_EQ(best != nullptr, std::any_of(codings.begin(), codings.end(), allowed));
            for (const TransferCoding& one : codings) {
                if (!allowed(one)) continue;
                EXPECT_TRUE(allowed(*best));
                EXPECT_LE(best->candidate.multiply_adds, one.candidate.multiply_adds);
                if (best->candidate.multiply_adds == one.candidate.multiply_adds) {
                    EXPECT_LE(best->candidate.bytes, one.candidate.bytes);
                }
            }
        }
    }
}

class TransferSearchTest : public testing::Test {
  protected:
    TransferSearchTest() {
        options_.precision = Precision::i16;
        target_.transfer_error = 0.02;
        target_.spectrum = BandPower::flat(4);
        problem_.emplace(read_problem(bake_, options_, target_));
        most_error_ = 0.02 * 0.02 * problem_->transfer_energy;
    }

    std::vector<TransferCoding> codings() const {
        return TransferSearch(*problem_, options_, target_).codings(most_error_);
    }

    // Against the factors, weighted, without the rounding of weights.
    double error_of(const TransferCoding& coding) const {
        if (!is_integer(coding.precision)) {
            const auto tails = problem_->transfer.num_components();
            double left = 0.0;
            for (uint32_t k = coding.quantiser.num_components; k < tails; ++k) {
                for (uint32_t j = 0; j < problem_->transfer.num_planes; ++j) {
                    for (const float x :
                         problem_->transfer.plane(problem_->transfer.components[k], j)) {
                        left += problem_->plane_weight[j] * double{x} * double{x};
                    }
                }
            }
            return left * problem_->transfer.num_poses();
        }
        return coding.settings->squared_error(*problem_, coding.quantiser);
    }

    const TemporaryDirectory directory_;
    const BakeReader bake_ = write_target_bake(directory_ / "x.bake", {});
    EncodeOptions options_;
    EncodeTarget target_;
    std::optional<EncodeProblem> problem_;
    double most_error_ = 0.0;
};

TEST_F(TransferSearchTest, AllCandidatesMeetTheError) {
    size_t num_svd = 0, num_cpca = 0;
    for (const TransferCoding& coding : codings()) {
        const bool is_cpca = coding.candidate.number("clusters") > 0;
        EXPECT_EQ(coding.candidate.codec, is_cpca ? "cpca" : "svd");
        (is_cpca ? num_cpca : num_svd) += 1;
        EXPECT_LE(error_of(coding), most_error_);
        // Steps are the largest: within 1 %, but for what dropped components leave.
        EXPECT_GT(error_of(coding), 0.9 * most_error_);
        EXPECT_EQ(coding.candidate.bands, 4u);
        EXPECT_GT(coding.candidate.bytes, 0u);
    }
    EXPECT_GE(num_svd, 2u);
    EXPECT_GE(num_cpca, 2u);
}

TEST_F(TransferSearchTest, FloatsKeepTheFewestComponentsThatMeetTheError) {
    options_.precision = Precision::f32;
    const std::vector<TransferCoding> found = codings();
    ASSERT_EQ(found.size(), 1u);
    TransferCoding coding = found[0];
    EXPECT_LE(error_of(coding), most_error_);
    ASSERT_GT(coding.quantiser.num_components, 0u);
    --coding.quantiser.num_components;
    EXPECT_GT(error_of(coding), most_error_);
}

TEST_F(TransferSearchTest, OneCodecIsTriedWhereOneIsAskedFor) {
    for (const std::string codec : {"svd", "cpca"}) {
        target_.codec = codec;
        const std::vector<TransferCoding> found = codings();
        EXPECT_FALSE(found.empty());
        for (const TransferCoding& coding : found) {
            EXPECT_EQ(coding.candidate.codec, codec);
        }
    }
}

TEST_F(TransferSearchTest, NoCandidateCostsMoreThanAllowed) {
    std::vector<uint32_t> costs;
    for (const TransferCoding& coding : codings()) costs.push_back(coding.candidate.multiply_adds);
    std::sort(costs.begin(), costs.end());
    const uint32_t least = costs.front();
    ASSERT_LT(least, costs[costs.size() / 2]);
    target_.decode_cost = costs[costs.size() / 2];
    const std::vector<TransferCoding> cheap = codings();
    EXPECT_FALSE(cheap.empty());
    for (const TransferCoding& coding : cheap) {
        EXPECT_LE(coding.candidate.multiply_adds, *target_.decode_cost);
        EXPECT_LE(error_of(coding), most_error_);
    }
    // None at all, and what it would take.
    target_.decode_cost = 2;
    TransferSearch search(*problem_, options_, target_);
    EXPECT_TRUE(search.codings(most_error_).empty());
    EXPECT_EQ(search.least_multiply_adds(most_error_), least);
    EXPECT_TRUE(search.codings(most_error_).empty());
    EXPECT_FALSE(search.least_multiply_adds(0.0));
}

// At all times only the best of those before: memory is for one.
TEST_F(TransferSearchTest, NoneButTheBestKeepsItsBases) {
    for (const Preference preference : {Preference::size, Preference::speed}) {
        target_.preference = preference;
        target_.codec = "cpca";
        const std::vector<TransferCoding> found = codings();
        const TransferCoding* best = best_coding(found, target_.preference);
        for (const TransferCoding& coding : found) {
            EXPECT_TRUE(coding.settings->held_bytes() == 0 || &coding == best);
        }
        // The cheapest to play is never displaced by what comes later.
        EXPECT_TRUE(preference == Preference::size || best->settings->held_bytes() > 0);
    }
}

}  // namespace
}  // namespace paim
