// Recommendations whose answers are known.
#include "analysis/trade/recommend.h"

#include <gtest/gtest.h>

#include <limits>

#include "paim/base/error.h"

namespace paim {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
using Of = TradeLimit::Of;

const std::vector<TradeValues> kValues{
    {0.010, 400, 90},  // 0
    {0.011, 300, 80},  // 1
    {0.020, 200, 70},  // 2
    {0.020, 200, 60},  // 3: as 2, and cheaper to play
    {0.030, 250, 20},  // 4
};

TEST(Recommend, FewestBytesWithinAnErrorAndOfEqualsFewestMultiplyAdds) {
    EXPECT_EQ(best_point(kValues, {Of::error, 0.05}), 3u);
    EXPECT_EQ(best_point(kValues, {Of::error, 0.015}), 1u);
    EXPECT_EQ(best_point(kValues, {Of::error, 0.0105}), 0u);
    EXPECT_EQ(best_point(kValues, {Of::error, 0.010}), 0u) << "at most";
    EXPECT_EQ(best_point({{0.1, 5, 5}, {0.1, 5, 5}}, {Of::error, 0.2}), 0u) << "the first";
}

TEST(Recommend, CheapestToPlayWithinAnError) {
    EXPECT_EQ(cheapest_point(kValues, {Of::error, 0.05}), 4u);
    EXPECT_EQ(cheapest_point(kValues, {Of::error, 0.025}), 3u);
    // Of equals the fewest bytes.
    EXPECT_EQ(cheapest_point({{0.1, 6, 5}, {0.1, 5, 5}}, {Of::error, 0.2}), 1u);
}

TEST(Recommend, SmallestErrorWithinBytes) {
    EXPECT_EQ(best_point(kValues, {Of::bytes, 1000.0}), 0u);
    EXPECT_EQ(best_point(kValues, {Of::bytes, 300.0}), 1u);
    EXPECT_EQ(best_point(kValues, {Of::bytes, 299.0}), 3u);
    EXPECT_EQ(best_point({{0.1, 6, 5}, {0.1, 5, 5}}, {Of::bytes, 9.0}), 1u) << "fewer bytes";
}

TEST(Recommend, SmallestErrorWithinMultiplyAdds) {
    EXPECT_EQ(best_point(kValues, {Of::multiply_adds, 85.0}), 1u);
    EXPECT_EQ(best_point(kValues, {Of::multiply_adds, 60.0}), 3u);
    EXPECT_EQ(best_point(kValues, {Of::multiply_adds, 59.0}), 4u);
}

TEST(Recommend, NothingWhereNothingIsWithin) {
    for (const TradeLimit limit : {TradeLimit{Of::error, 0.009}, TradeLimit{Of::bytes, 199.0},
                                   TradeLimit{Of::multiply_adds, 19.0}}) {
        EXPECT_FALSE(best_point(kValues, limit));
        EXPECT_FALSE(cheapest_point(kValues, limit));
    }
    EXPECT_FALSE(best_point({}, {Of::error, 1.0}));
}

TEST(Recommend, UnknownErrorsAreNeverRecommended) {
    const std::vector<TradeValues> values{{kNotMeasured, 1, 1}, {0.1, 10, 10}};
    for (const Of of : {Of::error, Of::bytes, Of::multiply_adds}) {
        EXPECT_EQ(best_point(values, {of, 1000.0}), 1u);
        EXPECT_FALSE(best_point({values[0]}, {of, 1000.0}));
    }
    EXPECT_EQ(cheapest_point(values, {Of::error, 1.0}), 1u);
}

TEST(Recommend, SaysWhatTheNearestHas) {
    const auto message = [](const std::vector<TradeValues>& values, const TradeLimit& limit,
                            TradeError kind) -> std::string {
        try {
            throw_nothing_within(values, limit, kind);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::threshold_exceeded);
            return error.what();
        }
    };
    EXPECT_EQ(message(kValues, {Of::error, 0.005}, TradeError::visual),
              "no file of the sweep has a visual error of at most 0.5 %; the least is 1 %");
    EXPECT_EQ(message(kValues, {Of::error, 0.005}, TradeError::transfer),
              "no file of the sweep has a transfer error of at most 0.5 %; the least is 1 %");
    EXPECT_EQ(message(kValues, {Of::bytes, 100.0}, TradeError::visual),
              "no file of the sweep has at most 100 bytes; the least is 200");
    EXPECT_EQ(message(kValues, {Of::multiply_adds, 6.0}, TradeError::visual),
              "no file of the sweep has at most 6 multiply-adds a vertex and frame; the least is "
              "20");
    EXPECT_EQ(message({}, {Of::bytes, 100.0}, TradeError::visual),
              "no file of the sweep has at most 100 bytes: no file could be made");
}

}  // namespace
}  // namespace paim
