// Fronts of points whose order is known.
#include "analysis/trade/pareto.h"

#include <gtest/gtest.h>

#include <limits>

#include "paim/base/seed.h"
#include "tests/unit/analysis/trade/trade_points.h"

namespace paim {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
using Front = std::vector<size_t>;

TEST(Pareto, KeepsWhatNothingBeats) {
    EXPECT_EQ(pareto_front({{0.1, 100, 10},    // the smallest error
                            {0.2, 50, 20},     // the fewest bytes
                            {0.3, 200, 5},     // the fewest multiply-adds
                            {0.2, 60, 30},     // beaten by the second
                            {0.1, 100, 11},    // beaten by the first in one thing
                            {0.15, 80, 15}}),  // between the first two
              (Front{0, 1, 2, 5}));
    EXPECT_EQ(pareto_front({}), Front());
    EXPECT_EQ(pareto_front({{0.5, 1, 1}}), Front{0});
}

TEST(Pareto, BeatsOnlyWhatIsAsGoodInEverything) {
    EXPECT_TRUE(beats({0.1, 10, 10}, {0.2, 10, 10}));
    EXPECT_TRUE(beats({0.1, 10, 10}, {0.1, 11, 10}));
    EXPECT_TRUE(beats({0.1, 10, 10}, {0.1, 10, 11}));
    EXPECT_FALSE(beats({0.1, 10, 10}, {0.1, 10, 10}));
    EXPECT_FALSE(beats({0.1, 10, 12}, {0.2, 20, 11}));
    EXPECT_FALSE(beats({kUnknown, 1, 1}, {0.1, 10, 10}));
    EXPECT_FALSE(beats({0.1, 1, 1}, {kUnknown, 10, 10}));
}

TEST(Pareto, OfEqualPointsTheFirstStays) {
    EXPECT_EQ(pareto_front({{0.2, 10, 10}, {0.1, 20, 10}, {0.2, 10, 10}}), (Front{0, 1}));
}

TEST(Pareto, UnknownErrorsAreOnNoFront) {
    EXPECT_EQ(pareto_front({{kUnknown, 1, 1}, {0.2, 10, 10}, {kUnknown, 2, 2}}), Front{1});
    EXPECT_EQ(pareto_front({{kUnknown, 1, 1}}), Front());
}

// By the definition: every point off the front is beaten by one on it, or equals one.
TEST(Pareto, EveryOtherPointIsBeatenByOneOfTheFront) {
    RandomStream random(3);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<TradeValues> values;
        for (int n = 0; n < 40; ++n) {
            // Few different numbers, so that there are ties.
            const auto number = [&] { return static_cast<uint64_t>(random.uniform() * 6.0); };
            values.push_back({0.01 * static_cast<double>(number()), number(), number()});
        }
        const Front front = pareto_front(values);
        for (size_t n = 0; n < values.size(); ++n) {
            const bool on_front = std::find(front.begin(), front.end(), n) != front.end();
            bool beaten = false, earlier = false;
            for (const size_t other : front) {
                beaten = beaten || beats(values[other], values[n]);
                const bool equal = values[other].error == values[n].error &&
                                   values[other].bytes == values[n].bytes &&
                                   values[other].multiply_adds == values[n].multiply_adds;
                earlier = earlier || (equal && other < n);
            }
            EXPECT_EQ(on_front, !beaten && !earlier);
        }
    }
}

TEST(Pareto, ErrorsAreVisualOnesWhereAnyWasMeasured) {
    const TradeSettings settings{3, "any", Preference::size, "5%"};
    std::vector<TradePoint> points{made_up_point(settings, 0.05, 100, 10),
                                   made_up_point(settings, 0.02, 200, 10)};
    mark_front(points);
    EXPECT_EQ(error_kind(points), TradeError::transfer);
    EXPECT_TRUE(points[0].on_front && points[1].on_front);
    // Seen alike: the larger file gains nothing.
    points[0].visual_error = points[1].visual_error = 0.01;
    mark_front(points);
    EXPECT_EQ(error_kind(points), TradeError::visual);
    EXPECT_TRUE(points[0].on_front);
    EXPECT_FALSE(points[1].on_front);
}

TEST(Pareto, AFileErrsAsMuchAsItsWorsePart) {
    TradePoint point = made_up_point({3, "any", Preference::size, "5%"}, 0.03, 1, 1);
    EXPECT_EQ(point.transfer_error(), 0.03);
    point.error.still.emplace().transfer.error = 0.04;
    EXPECT_EQ(point.transfer_error(), 0.04);
    point.error.still->transfer.error = 0.02;
    EXPECT_EQ(point.transfer_error(), 0.03);
}

}  // namespace
}  // namespace paim
