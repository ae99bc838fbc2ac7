// Which points of a trade are worth a look: those that no other point beats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "analysis/trade/trade_point.h"

namespace paim {

// Less is better in all three.
struct TradeValues {
    double error = 0.0;  // not a number: not measured
    uint64_t bytes = 0;
    uint64_t multiply_adds = 0;  // a vertex and frame
};

// Whether `a` is as good as `b` in everything, and better in something. What was not measured
// neither beats nor is beaten.
bool beats(const TradeValues& a, const TradeValues& b);

// Numbers of the points that none beats, ascending; of equal ones the first. Points whose error is
// not a number are never among them.
std::vector<size_t> pareto_front(const std::vector<TradeValues>& values);

std::vector<TradeValues> trade_values(const std::vector<TradePoint>& points, TradeError kind);

// Sets TradePoint::on_front.
void mark_front(std::vector<TradePoint>& points);

}  // namespace paim
