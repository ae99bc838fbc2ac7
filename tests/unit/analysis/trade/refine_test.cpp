// Points near a limit, on families of files whose laws are known.
#include "analysis/trade/refine.h"

#include <gtest/gtest.h>

#include "tests/unit/analysis/trade/trade_points.h"

namespace paim {
namespace {

using Of = TradeLimit::Of;

// Files whose visual error is half of what they were made for, to the power of 0.9; bytes fall
// with it, and multiply-adds in steps. Those of one band are larger than those of two.
TradePoint lawful_point(const TradeSettings& settings) {
    const double error = settings.transfer_error();
    TradePoint point = made_up_point(
        settings, error, static_cast<uint64_t>(4e4 / settings.bands * std::pow(error, -0.7)),
        static_cast<uint64_t>(std::ceil(-4.0 * std::log(error))));
    point.visual_error = 0.5 * std::pow(error, 0.9);
    return point;
}

std::vector<TradePoint> lawful_grid() {
    std::vector<TradePoint> points;
    for (const uint32_t bands : {2u, 1u}) {
        for (const char* const error : {"20%", "8%", "3%", "1%"}) {
            points.push_back(lawful_point({bands, "any", Preference::size, error}));
        }
    }
    return points;
}

struct Refinement {
    std::vector<TradePoint> points = lawful_grid();
    uint64_t num_counted = 0;

    explicit Refinement(const TradeLimit& limit) {
        refine_points(points, limit, &lawful_point, [&](uint64_t n) { num_counted += n; });
    }
    TradePoint best(const TradeLimit& limit) const {
        return points.at(*best_point(trade_values(points, TradeError::visual), limit));
    }
};

TEST(Refine, EndsWithinThreePercentOfAnError) {
    // Between points, at one, and beyond the largest.
    for (const double wanted : {0.04, 0.02, 0.0123, 0.5 * std::pow(0.08, 0.9), 0.2}) {
        const TradeLimit limit{Of::error, wanted};
        const Refinement refined(limit);
        const TradePoint best = refined.best(limit);
        EXPECT_LE(best.visual_error, wanted);
        EXPECT_GE(best.visual_error, kNearLimit * wanted);
        EXPECT_EQ(best.settings.bands, 2u);
        EXPECT_EQ(refined.num_counted, 2u * kMostRefined);
    }
}

TEST(Refine, EndsWithinThreePercentOfBytes) {
    for (const double wanted : {100e3, 200e3, 400e3}) {
        const TradeLimit limit{Of::bytes, wanted};
        const TradePoint best = Refinement(limit).best(limit);
        EXPECT_LE(static_cast<double>(best.size_bytes), wanted);
        EXPECT_GE(static_cast<double>(best.size_bytes), kNearLimit * wanted);
    }
}

// Multiply-adds come in steps: the smallest error of the step.
TEST(Refine, FindsTheSmallestErrorOfMultiplyAdds) {
    const TradeLimit limit{Of::multiply_adds, 12.0};
    const TradePoint best = Refinement(limit).best(limit);
    EXPECT_EQ(best.multiply_adds, 12u);
    // exp(−3) is the smallest one with 12. Five halvings of 3 … 8 %, about.
    EXPECT_NEAR(best.settings.transfer_error() / std::exp(-3.0), 1.0, 0.05);
}

TEST(Refine, AddsOnlyWhatCanBeBetter) {
    // All are within: there is no better one for bytes than the smallest error.
    EXPECT_EQ(Refinement({Of::bytes, 1e9}).points.size(), lawful_grid().size());
    // None is within.
    EXPECT_EQ(Refinement({Of::error, 1e-6}).points.size(), lawful_grid().size());
    EXPECT_EQ(Refinement({Of::error, 1e-6}).num_counted, 0u);
    // A grid point that is near enough already.
    const TradeLimit near{Of::error, 1.01 * 0.5 * std::pow(0.08, 0.9)};
    EXPECT_EQ(Refinement(near).points.size(), lawful_grid().size());
}

TEST(Refine, RefinedPointsSayThatTheyAre) {
    const Refinement refined({Of::error, 0.02});
    for (size_t n = 0; n < refined.points.size(); ++n) {
        EXPECT_EQ(refined.points[n].refined, n >= lawful_grid().size());
    }
    EXPECT_GT(refined.points.size(), lawful_grid().size());
}

TEST(Refine, GoesOnWhereAFileCannotBeMade) {
    std::vector<TradePoint> points = lawful_grid();
    uint32_t num_tried = 0;
    const TradeLimit limit{Of::error, 0.04};
    refine_points(
        points, limit,
        [&](const TradeSettings& settings) -> std::optional<TradePoint> {
            if (num_tried++ == 0) return std::nullopt;
            return lawful_point(settings);
        },
        [](uint64_t) {});
    const auto best = best_point(trade_values(points, TradeError::visual), limit);
    EXPECT_GT(num_tried, 1u);
    EXPECT_TRUE(points.at(*best).refined);
}

TEST(Refine, UnknownErrorsAreInNoBracket) {
    std::vector<TradePoint> points = lawful_grid();
    for (size_t n = 1; n < points.size(); ++n) {
        points[n].visual_error = std::numeric_limits<double>::quiet_NaN();
    }
    EXPECT_EQ(brackets(points, {Of::error, 0.5}, TradeError::visual).size(), 1u);
    EXPECT_TRUE(brackets(points, {Of::bytes, 1.0}, TradeError::visual).empty());
}

// Floats have no steps to choose, whatever they err.
TEST(Refine, LeavesPlainStorageAsItIs) {
    const TradeLimit limit{Of::error, 0.04};
    std::vector<TradePoint> points = lawful_grid();
    for (TradePoint& point : points) point.settings.precision = Precision::f32;
    EXPECT_TRUE(brackets(points, limit, TradeError::visual).empty());
    EXPECT_FALSE(brackets(lawful_grid(), limit, TradeError::visual).empty());
}

}  // namespace
}  // namespace paim
