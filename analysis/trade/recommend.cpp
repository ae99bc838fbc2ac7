// Which point of a trade a wanted limit asks for.
#include "analysis/trade/recommend.h"

#include <fmt/format.h>

#include <tuple>

#include "paim/base/error.h"

namespace paim {

namespace {

// The first point within the limit whose order is the smallest.
template <typename Order>
std::optional<size_t> first_within(const std::vector<TradeValues>& values, const TradeLimit& limit,
                                   const Order& order) {
    std::optional<size_t> best;
    for (size_t n = 0; n < values.size(); ++n) {
        if (!is_within(values[n], limit) || std::isnan(values[n].error)) continue;
        if (!best || order(values[n]) < order(values[*best])) best = n;
    }
    return best;
}

std::string value_text(double value, TradeLimit::Of of) {
    return of == TradeLimit::Of::error ? fmt::format("{:.3g} %", 100.0 * value)
                                       : fmt::format("{:.0f}", value);
}

}  // namespace

double value_of(const TradeValues& values, TradeLimit::Of of) {
    switch (of) {
        case TradeLimit::Of::error:
            return values.error;
        case TradeLimit::Of::bytes:
            return static_cast<double>(values.bytes);
        case TradeLimit::Of::multiply_adds:
            break;
    }
    return static_cast<double>(values.multiply_adds);
}

std::optional<size_t> best_point(const std::vector<TradeValues>& values, const TradeLimit& limit) {
    if (limit.of == TradeLimit::Of::error) {
        return first_within(values, limit, [](const TradeValues& one) {
            return std::tuple(one.bytes, one.multiply_adds);
        });
    }
    return first_within(values, limit, [](const TradeValues& one) {
        return std::tuple(one.error, one.bytes, one.multiply_adds);
    });
}

std::optional<size_t> cheapest_point(const std::vector<TradeValues>& values,
                                     const TradeLimit& limit) {
    return first_within(values, limit, [](const TradeValues& one) {
        return std::tuple(one.multiply_adds, one.bytes);
    });
}

std::string limit_text(const TradeLimit& limit, TradeError kind) {
    const std::string value = value_text(limit.at_most, limit.of);
    switch (limit.of) {
        case TradeLimit::Of::error:
            return fmt::format("a {} of at most {}", error_name(kind), value);
        case TradeLimit::Of::bytes:
            return fmt::format("at most {} bytes", value);
        case TradeLimit::Of::multiply_adds:
            break;
    }
    return fmt::format("at most {} multiply-adds a vertex and frame", value);
}

void throw_nothing_within(const std::vector<TradeValues>& values, const TradeLimit& limit,
                          TradeError kind) {
    std::optional<double> least;
    for (const TradeValues& one : values) {
        const double value = value_of(one, limit.of);
        if (!std::isnan(value) && !(least && *least <= value)) least = value;
    }
    throw Error(ExitCode::threshold_exceeded,
                fmt::format("no file of the sweep has {}{}", limit_text(limit, kind),
                            least ? "; the least is " + value_text(*least, limit.of)
                                  : std::string(": no file could be made")));
}

}  // namespace paim
