// The points of a trade as CSV and JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

#include "analysis/trade/trade_point.h"

namespace paim {

// A line for each point, units in the header. Times come last, each in a column of its own: all
// else is the same on every run and on any number of threads.
std::string trade_csv(const std::vector<TradePoint>& points);

// The same numbers.
nlohmann::ordered_json trade_point_json(const TradePoint& point);

}  // namespace paim
