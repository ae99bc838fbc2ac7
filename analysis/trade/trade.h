// What a bake's files cost for what they err, and which of them to make.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/trade/recommend.h"
#include "analysis/trade/trade_point.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

struct TradeOptions {
    std::vector<uint32_t> bands;      // empty: usual_bands(); those above the bake's are left out
    std::vector<std::string> errors;  // --max-error as it is written; empty: usual_errors()
    std::optional<TradeLimit> limit;  // what is wanted, for a recommendation
    // Rays a vertex of further bakes of the same poses, which are made for the sweep.
    std::vector<uint32_t> rays = {};
    std::vector<Precision> precisions = {};  // i16, f16, f32; empty: all three
};

struct Trade {
    TradeError kind = TradeError::transfer;  // what errors of the front and of the limit are
    std::vector<TradePoint> points;
    std::vector<std::string> notes;  // of what was left out
    std::optional<TradeLimit> limit;
    std::optional<size_t> best;      // of the points, within the limit
    std::optional<size_t> cheapest;  // to play; only for an error
};

// Makes and measures all files of the grid, then those that the limit needs.
// bake     verified (BakeReader::verify_all)
// scratch  directory for a file at a time
Trade measure_trade(const BakeReader& bake, const TradeOptions& options,
                    const std::filesystem::path& scratch, const PlayFile& play, bool quiet);

// What to run for the limit, and what that gives; empty without a limit.
std::string recommendation_text(const std::filesystem::path& bake, const Trade& trade);

nlohmann::ordered_json trade_json(const std::filesystem::path& bake, const Trade& trade);

// Error (threshold exceeded): there is a limit, and no file is within it.
void check_limit(const Trade& trade);

}  // namespace paim
