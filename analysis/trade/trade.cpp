// What a bake's files cost for what they err, and which of them to make.
#include "analysis/trade/trade.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "analysis/reference/baked_poses.h"
#include "analysis/scratch_directory.h"
#include "analysis/trade/encode_command.h"
#include "analysis/trade/grid.h"
#include "analysis/trade/refine.h"
#include "analysis/trade/sweep.h"
#include "analysis/trade/table.h"
#include "paim/cli/progress.h"

namespace paim {

namespace {

// Those that are asked for and that the bake has, descending.
std::vector<uint32_t> bands_of(const BakeReader& bake, const TradeOptions& options,
                               std::vector<std::string>& notes) {
    const uint32_t baked = bake.identity().layout.in_bands;
    if (options.bands.empty()) return usual_bands(baked);
    std::vector<uint32_t> bands = options.bands;
    std::sort(bands.rbegin(), bands.rend());
    bands.erase(std::unique(bands.begin(), bands.end()), bands.end());
    const auto kept =
        std::find_if(bands.begin(), bands.end(), [&](uint32_t number) { return number <= baked; });
    for (auto beyond = bands.begin(); beyond != kept; ++beyond) {
        notes.push_back(fmt::format("{} bands are left out: the bake has {}", *beyond, baked));
    }
    return {kept, bands.end()};
}

// Descending, each once.
std::vector<std::string> errors_of(const TradeOptions& options) {
    std::vector<std::string> errors = options.errors.empty() ? usual_errors() : options.errors;
    std::stable_sort(errors.begin(), errors.end(), [](const auto& a, const auto& b) {
        return max_error_of(a) > max_error_of(b);
    });
    errors.erase(std::unique(errors.begin(), errors.end(),
                             [](const auto& a, const auto& b) {
                                 return max_error_of(a) == max_error_of(b);
                             }),
                 errors.end());
    return errors;
}

SweepAxes axes_of(const TradeOptions& options) {
    SweepAxes axes;
    axes.errors = errors_of(options);
    axes.plain_errors = options.errors.empty() ? std::vector{usual_plain_error()} : axes.errors;
    axes.precisions = options.precisions.empty()
                          ? std::vector<Precision>(kSweepPrecisions.begin(), kSweepPrecisions.end())
                          : options.precisions;
    return axes;
}

void refine_trade(Sweep& sweep, const TradeLimit& limit, Trade& trade, bool quiet) {
    const size_t num_brackets =
        std::min(kMostBrackets, brackets(trade.points, limit, trade.kind).size());
    if (num_brackets == 0) return;
    cli::Progress progress("refining", "files", num_brackets * kMostRefined, quiet);
    refine_points(
        trade.points, limit, [&](const TradeSettings& settings) { return sweep.measure(settings); },
        [&](uint64_t points) { progress.advance(points); });
    progress.finish();
}

// Adds the files of another bake of the same poses, which is made and removed.
void add_other_bake(const BakeReader& bake, uint32_t rays, const std::vector<uint32_t>& bands,
                    const SweepAxes& axes, const std::filesystem::path& scratch,
                    const PlayFile& play, Trade& trade, bool quiet) {
    const ScratchDirectory directory(scratch, fmt::format("sweep-{}", rays));
    const std::filesystem::path path = directory.path() / "other.bake";
    cli::Progress baking(fmt::format("baking {} rays", rays), "poses", bake.num_poses(), quiet);
    const auto start = std::chrono::steady_clock::now();
    BakeOptions options = options_of(bake.identity());
    options.rays = rays;
    bake_again(bake, options, path, [&](uint32_t) { baking.advance(); });
    const std::chrono::duration<double> bake_time = std::chrono::steady_clock::now() - start;
    baking.finish();
    const BakeReader other(path);
    Sweep sweep(other, file_stem(bake.directory()), scratch / "trade-point.paim", play);
    cli::Progress progress(fmt::format("sweep of {} rays", rays), "files",
                           bands.size() * num_points(axes), quiet);
    std::vector<TradePoint> points;
    for (const uint32_t number : bands) {
        sweep.measure_all(number, axes, points, [&](uint64_t count) { progress.advance(count); });
    }
    progress.finish();
    for (TradePoint& point : points) {
        point.settings.rays = rays;
        point.bake_s = bake_time.count();
        trade.points.push_back(std::move(point));
    }
    for (const std::string& note : sweep.notes()) {
        trade.notes.push_back(fmt::format("{} rays: {}", rays, note));
    }
}

nlohmann::ordered_json recommended_json(const std::filesystem::path& bake,
                                        const TradePoint& point) {
    nlohmann::ordered_json json;
    json["command"] = encode_command(bake, point.settings);
    json["point"] = trade_point_json(point);
    return json;
}

}  // namespace

Trade measure_trade(const BakeReader& bake, const TradeOptions& options,
                    const std::filesystem::path& scratch, const PlayFile& play, bool quiet) {
    Trade trade;
    trade.limit = options.limit;
    const std::vector<uint32_t> bands = bands_of(bake, options, trade.notes);
    const SweepAxes axes = axes_of(options);
    Sweep sweep(bake, file_stem(bake.directory()), scratch / "trade-point.paim", play);
    cli::Progress progress("sweep", "files", bands.size() * num_points(axes), quiet);
    for (const uint32_t number : bands) {
        sweep.measure_all(number, axes, trade.points,
                          [&](uint64_t points) { progress.advance(points); });
    }
    progress.finish();
    trade.kind = error_kind(trade.points);
    if (trade.limit) refine_trade(sweep, *trade.limit, trade, quiet);
    trade.notes.insert(trade.notes.end(), sweep.notes().begin(), sweep.notes().end());
    for (const uint32_t rays : options.rays) {
        add_other_bake(bake, rays, bands, axes, scratch, play, trade, quiet);
    }
    mark_front(trade.points);
    if (!trade.limit) return trade;
    const std::vector<TradeValues> values = trade_values(trade.points, trade.kind);
    trade.best = best_point(values, *trade.limit);
    if (trade.limit->of == TradeLimit::Of::error) {
        trade.cheapest = cheapest_point(values, *trade.limit);
    }
    return trade;
}

nlohmann::ordered_json trade_json(const std::filesystem::path& bake, const Trade& trade) {
    nlohmann::ordered_json json;
    json["bake"] = bake.string();
    json["error"] = trade.kind == TradeError::visual ? "visual_error" : "transfer_total_error";
    if (trade.limit) json["limit"] = limit_text(*trade.limit, trade.kind);
    if (trade.best) json["best"] = recommended_json(bake, trade.points[*trade.best]);
    if (trade.cheapest) json["cheapest"] = recommended_json(bake, trade.points[*trade.cheapest]);
    json["points"] = nlohmann::ordered_json::array();
    for (const TradePoint& point : trade.points) json["points"].push_back(trade_point_json(point));
    json["notes"] = trade.notes;
    return json;
}

void check_limit(const Trade& trade) {
    if (!trade.limit || trade.best) return;
    throw_nothing_within(trade_values(trade.points, trade.kind), *trade.limit, trade.kind);
}

}  // namespace paim
