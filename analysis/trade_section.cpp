// The section of cost against error.
#include <fmt/format.h>

#include "analysis/analysis_run.h"
#include "analysis/trade/seen_error.h"
#include "analysis/trade/table.h"
#include "analysis/trade/trade_report.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"

namespace paim {

Trade trade_section(AnalysisRun& run) {
    const std::filesystem::path& output = run.page.directory();
    const PlayFile play = play_on_stage(run.bake, run.stage, run.reference().source);
    Trade trade = measure_trade(run.bake, *run.options.trade, output, play, run.quiet());
    const nlohmann::ordered_json json = trade_json(run.bake.directory(), trade);
    write_file(output / "trade.csv", trade_csv(trade.points));
    write_file(output / "trade.json", json_text(json, 2) + "\n");
    if (run.with_plots) write_trade_plots(output, trade);
    for (const std::string& note : trade.notes) {
        fmt::print(stderr, "paim-analyze: note: {}\n", note);
    }
    run.json["trade"] = json;
    add_trade(run.page, run.bake.directory(), trade);
    return trade;
}

}  // namespace paim
