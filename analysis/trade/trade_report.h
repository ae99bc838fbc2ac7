// Cost against error as charts and a section of the page.
#pragma once

#include <filesystem>

#include "analysis/page.h"
#include "analysis/trade/trade.h"

namespace paim {

// The charts that write_trade_plots() makes, bytes and multiply-adds against the error.
inline constexpr const char* kTradePlots[] = {"trade_bytes.svg", "trade_cost.svg"};

// A point for each file, and a line through those that no other beats in what the chart shows.
// Errors: those of run_gnuplot().
void write_trade_plots(const std::filesystem::path& directory, const Trade& trade);

// seen_by  what visual errors are of: "the larger one of venice and forest, against the bake"
void add_trade(Page& page, const std::filesystem::path& bake, const Trade& trade,
               const std::string& seen_by);

}  // namespace paim
