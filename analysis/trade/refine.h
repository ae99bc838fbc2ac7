// Points between those of a grid, near a wanted limit.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/trade/recommend.h"
#include "analysis/trade/trade_point.h"

namespace paim {

// Points within a limit are near it from this share of it on.
constexpr double kNearLimit = 0.97;
// The most points that one family gets.
constexpr int kMostRefined = 5;

// Points that differ in --max-error alone, where the limit lies between two of them that were
// measured: `within` is within it, `beyond` is not.
struct Bracket {
    TradePoint within;
    // Without a point: an error that is as large as any file may have.
    double beyond_error = 0.0;  // --max-error
    std::optional<TradePoint> beyond;
    // What the point at the limit is expected to have: bytes for an error, else the error; and
    // multiply-adds.
    double expected = 0.0, expected_multiply_adds = 0.0;
    int num_tried = 0;  // points between the first two
};

// One for each combination of bands, codec and preference in which some point is within the limit
// and a better one is thinkable, the most promising first.
std::vector<Bracket> brackets(const std::vector<TradePoint>& points, const TradeLimit& limit,
                              TradeError kind);

// The --max-error to try next, between the two; nothing if the bracket is near enough.
std::optional<std::string> next_error(const Bracket& bracket, const TradeLimit& limit,
                                      TradeError kind);

// Measures points in the most promising brackets until one of each is near the limit, and adds
// them. Of multiply-adds, which come in steps, brackets are halved.
// measure    nothing if there is no such file
// on_points  of each bracket kMostRefined in all, whatever it takes
void refine_points(std::vector<TradePoint>& points, const TradeLimit& limit,
                   const std::function<std::optional<TradePoint>(const TradeSettings&)>& measure,
                   const std::function<void(uint64_t)>& on_points);

// How many brackets are refined, at most.
constexpr size_t kMostBrackets = 4;

}  // namespace paim
