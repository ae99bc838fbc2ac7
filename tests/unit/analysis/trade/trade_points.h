// Points of a trade with numbers that are made up.
#pragma once

#include <cmath>
#include <string>

#include "analysis/trade/grid.h"
#include "analysis/trade/trade_point.h"

namespace paim {

// A point of this transfer error.
inline TradePoint made_up_point(const TradeSettings& settings, double transfer_error,
                                uint64_t size_bytes, uint64_t multiply_adds) {
    TradePoint point;
    point.settings = settings;
    point.error.transfer.error = transfer_error;
    point.size_bytes = size_bytes;
    point.multiply_adds = multiply_adds;
    return point;
}

}  // namespace paim
