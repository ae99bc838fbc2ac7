// Which point of a trade a wanted limit asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/trade/pareto.h"

namespace paim {

// What a file may have at most.
struct TradeLimit {
    enum class Of { error, bytes, multiply_adds } of = Of::error;
    double at_most = 0.0;  // a fraction, bytes, or multiply-adds a vertex and frame
};

double value_of(const TradeValues& values, TradeLimit::Of of);

// Written so that NaN is never within.
inline bool is_within(const TradeValues& values, const TradeLimit& limit) {
    return value_of(values, limit.of) <= limit.at_most;
}

// The point within the limit that is best in the rest: for an error the fewest bytes, then
// multiply-adds; for bytes and multiply-adds the smallest error, then bytes, then multiply-adds. The
// first of equals. Nothing if no point is within it, or none of those has a known error.
std::optional<size_t> best_point(const std::vector<TradeValues>& values, const TradeLimit& limit);

// Of those within an error the one that is cheapest to play: the fewest multiply-adds, then bytes.
std::optional<size_t> cheapest_point(const std::vector<TradeValues>& values,
                                     const TradeLimit& limit);

// "a visual error of at most 1 %", "at most 200000 bytes", "at most 60 multiply-adds a vertex and
// frame".
std::string limit_text(const TradeLimit& limit, TradeError kind);

// Error (threshold exceeded): no point is within the limit; says what the nearest one has.
[[noreturn]] void throw_nothing_within(const std::vector<TradeValues>& values,
                                       const TradeLimit& limit, TradeError kind);

}  // namespace paim
