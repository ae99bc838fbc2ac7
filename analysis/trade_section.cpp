// The section of cost against error.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

#include "analysis/analysis_run.h"
#include "analysis/trade/seen_error.h"
#include "analysis/trade/table.h"
#include "analysis/trade/trade_report.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"

namespace paim {

namespace {

// "the larger one of venice and forest, over 4 poses in 2 views, against the bake"
std::string seen_by(AnalysisRun& run) {
    std::vector<std::string> names;
    for (const NamedLight& light : run.stage.lights()) names.push_back(light.name);
    return fmt::format("{}{}, over {} poses in {}, against {}",
                       names.size() > 1 ? "the largest one of " : "that of ",
                       fmt::join(names, ", "), run.stage.poses().size(), run.stage.views_text(),
                       run.reference_text());
}

}  // namespace

Trade trade_section(AnalysisRun& run) {
    const std::filesystem::path& output = run.page.directory();
    std::vector<double> noise;
    const PlayFile play = play_on_stage(run.bake, run.stage, run.reference().source, noise);
    Trade trade = measure_trade(run.bake, *run.options.trade, output, play, run.quiet());
    const nlohmann::ordered_json json = trade_json(run.bake.directory(), trade);
    write_file(output / "trade.csv", trade_csv(trade.points));
    write_file(output / "trade.json", json_text(json, 2) + "\n");
    if (run.with_plots) write_trade_plots(output, trade);
    for (const std::string& note : trade.notes) {
        fmt::print(stderr, "paim-analyze: note: {}\n", note);
    }
    // Which light an error is of is not known any more: it is judged by the noise of each.
    double smallest = std::numeric_limits<double>::infinity();
    for (const TradePoint& point : trade.points) smallest = std::fmin(smallest, point.visual_error);
    for (size_t light = 0; light < noise.size(); ++light) {
        run.say_if_noise_is_large(light, noise[light], smallest);
    }
    run.json["trade"] = json;
    add_trade(run.page, run.bake.directory(), trade, seen_by(run));
    return trade;
}

}  // namespace paim
