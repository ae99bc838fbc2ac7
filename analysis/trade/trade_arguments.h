// The options of a sweep on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/trade/trade.h"

namespace paim {

// Values whose form is checked after parsing.
struct TradeArguments {
    bool sweep = false;
    std::optional<std::string> target, target_size;
    std::optional<uint32_t> target_cost;
    std::optional<std::string> rays, bands, errors, precisions;
};

void add_trade_options(CLI::App& app, TradeArguments& arguments);

// Nothing if no sweep is asked for. Error (usage) for values out of range.
std::optional<TradeOptions> trade_options(const TradeArguments& arguments);

}  // namespace paim
