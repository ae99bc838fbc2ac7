// Cost against error as charts and a section of the page.
#include "analysis/trade/trade_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/gnuplot.h"
#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

namespace {

using PlotPlace = std::pair<double, double>;  // error in percent, cost

// Places that no other has less of both than, by ascending error.
std::vector<PlotPlace> lower_front(std::vector<PlotPlace> places) {
    std::sort(places.begin(), places.end());
    std::vector<PlotPlace> front;
    for (const PlotPlace& place : places) {
        if (front.empty() || place.second < front.back().second) front.push_back(place);
    }
    return front;
}

std::string data_block(const std::string& name, const std::vector<PlotPlace>& places) {
    std::string text = "$" + name + " << EOD\n";
    for (const auto& [error, cost] : places) text += fmt::format("{:.9g} {:.9g}\n", error, cost);
    return text + "EOD\n";
}

// What a file was encoded for: "size", "speed"; or how floats were stored without a target: "f32".
const char* way_text(const TradeSettings& settings) {
    return settings.is_plain() ? precision_name(settings.precision)
                               : preference_name(settings.preference);
}

void write_trade_plot(const std::filesystem::path& output, const Trade& trade,
                      const std::string& y_label,
                      const std::function<double(const TradePoint&)>& cost) {
    std::map<std::string, std::vector<PlotPlace>> series;  // by what a legend says
    std::vector<PlotPlace> all;
    for (const TradePoint& point : trade.points) {
        const double error = 100.0 * error_of(point, trade.kind);
        if (!std::isfinite(error) || error <= 0.0) continue;
        all.emplace_back(error, cost(point));
        series[fmt::format("{}, {}", point.settings.codec, way_text(point.settings))].push_back(
            all.back());
    }
    if (all.empty()) {  // an older chart would be shown instead
        std::error_code ignored;
        std::filesystem::remove(output, ignored);
        return;
    }
    std::string script = gnuplot_begin(output, y_label + " against error");
    script += fmt::format(
        "set xlabel '{}, percent'\nset ylabel {}\nset logscale xy\nset format '%g'\nset grid\n"
        "set key outside right top\nset terminal svg size 760,420 noenhanced font 'sans,13' "
        "background 'white'\n",
        error_name(trade.kind), gnuplot_text(y_label));
    script += data_block("front", lower_front(all));
    std::string plots = "$front using 1:2 with steps lc 'gray' lw 2 title 'Pareto front'";
    size_t n = 0;
    for (const auto& [name, places] : series) {
        script += data_block(fmt::format("data{}", n), places);
        plots += fmt::format(", $data{} using 1:2 with points pt {} ps 0.8 title {}", n,
                             n % 2 == 0 ? 7 : 6, gnuplot_text(name));
        ++n;
    }
    run_gnuplot(script + "plot " + plots + "\n", output);
}

// What the numbers of codecs are, in the words of their encoders.
std::string numbers_heading() {
    std::string heading;
    for (const TransferEncoderType& type : transfer_encoders()) {
        if (type.words.numbers.empty()) continue;
        heading += fmt::format("{}{}", heading.empty() ? "" : "; ", type.words.heading);
    }
    return heading;
}

std::vector<std::string> row_of(const TradePoint& point, TradeError kind) {
    std::string numbers;
    for (const CodecNumber& one : point.numbers) {
        numbers += fmt::format("{}{}", numbers.empty() ? "" : " x ", one.value);
    }
    const TradeSettings& settings = point.settings;
    return {settings.keeps_all_components() ? "all" : settings.max_error,
            settings.is_plain() ? "" : fmt::format("{:.2g} %", 100.0 * settings.geometry_target()),
            settings.codec,
            way_text(settings),
            std::to_string(settings.bands),
            fmt::format("{}, {}", point.geometry_components, point.transfer_components),
            numbers,
            percent_text(error_of(point, kind)),
            percent_text(point.transfer_error()),
            std::to_string(point.size_bytes),
            std::to_string(point.multiply_adds),
            fmt::format("{:.3g}", point.frame_ms),
            fmt::format("{:.2g}", point.encode_s + point.shared_s)};
}

}  // namespace

void write_trade_plots(const std::filesystem::path& directory, const Trade& trade) {
    write_trade_plot(directory / kTradePlots[0], trade, "bytes of the file",
                     [](const TradePoint& point) { return static_cast<double>(point.size_bytes); });
    write_trade_plot(
        directory / kTradePlots[1], trade, "multiply-adds a vertex and frame",
        [](const TradePoint& point) { return static_cast<double>(point.multiply_adds); });
}

void add_trade(Page& page, const std::filesystem::path& bake, const Trade& trade,
               const std::string& seen_by) {
    page.add_heading("Cost against error");
    page.add_paragraph(fmt::format(
        "Each point is a file of this bake, made with other settings and measured. In the table are the "
        "files that no other file beats in {}, bytes and multiply-adds of the lit transfer at once; all {} "
        "are in trade.csv. The {} is {}.",
        error_name(trade.kind), trade.points.size(), error_name(trade.kind), seen_by));
    if (trade.best) {
        page.add_paragraph("For " + limit_text(*trade.limit, trade.kind) + ", of the files tried:");
        page.add_code(recommendation_text(bake, trade));
    }
    page.add_plots({kTradePlots[0], kTradePlots[1]});
    PageTable table{{"error asked for", "geometry-error", "codec", "prefer, or floats", "bands",
                     "components of geometry, transfer", numbers_heading(), error_name(trade.kind),
                     "transfer error", "bytes", "multiply-adds", "frame, ms", "encode, s"}};
    std::vector<const TradePoint*> front;
    for (const TradePoint& point : trade.points) {
        if (point.on_front) front.push_back(&point);
    }
    std::stable_sort(front.begin(), front.end(), [&](const auto* a, const auto* b) {
        return error_of(*a, trade.kind) < error_of(*b, trade.kind);
    });
    for (const TradePoint* point : front) table.push_back(row_of(*point, trade.kind));
    page.add_table(table);
    for (const std::string& note : trade.notes) page.add_paragraph("Note: " + note);
    page.add_link("trade.csv");
    page.add_link("trade.json");
}

}  // namespace paim
