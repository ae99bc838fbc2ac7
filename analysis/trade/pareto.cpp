// The points of a trade that no other point beats.
#include "analysis/trade/pareto.h"

namespace paim {

bool beats(const TradeValues& a, const TradeValues& b) {
    // Written so that NaN never beats and is never beaten.
    const bool as_good =
        a.error <= b.error && a.bytes <= b.bytes && a.multiply_adds <= b.multiply_adds;
    return as_good && (a.error < b.error || a.bytes < b.bytes || a.multiply_adds < b.multiply_adds);
}

std::vector<size_t> pareto_front(const std::vector<TradeValues>& values) {
    const auto equal = [](const TradeValues& a, const TradeValues& b) {
        return a.error == b.error && a.bytes == b.bytes && a.multiply_adds == b.multiply_adds;
    };
    std::vector<size_t> front;
    for (size_t n = 0; n < values.size(); ++n) {
        bool good = !std::isnan(values[n].error);
        for (size_t other = 0; good && other < values.size(); ++other) {
            good =
                !beats(values[other], values[n]) && !(other < n && equal(values[other], values[n]));
        }
        if (good) front.push_back(n);
    }
    return front;
}

std::vector<TradeValues> trade_values(const std::vector<TradePoint>& points, TradeError kind) {
    std::vector<TradeValues> values;
    for (const TradePoint& point : points) {
        values.push_back({error_of(point, kind), point.size_bytes, point.multiply_adds});
    }
    return values;
}

void mark_front(std::vector<TradePoint>& points) {
    for (TradePoint& point : points) point.on_front = false;
    for (const size_t n : pareto_front(trade_values(points, error_kind(points)))) {
        points[n].on_front = true;
    }
}

}  // namespace paim
