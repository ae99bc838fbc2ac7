// Error curves as SVG, drawn by gnuplot.
#include "analysis/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "analysis/gnuplot.h"

namespace paim {

namespace {

// Errors of 0 are drawn at this value of the logarithmic axis.
constexpr double kFloor = 1e-7;

struct Series {
    std::string title;
    std::vector<std::pair<double, double>> points;
    bool measured = true;  // drawn with a mark at each point
};

// The range of x over all series, with a little room around a single value.
std::pair<double, double> x_range(const std::vector<Series>& series, bool from_zero) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const Series& one : series) {
        for (const auto& [x, y] : one.points) {
            lowest = std::min(lowest, x);
            highest = std::max(highest, x);
        }
    }
    if (from_zero) lowest = std::min(lowest, 0.0);
    if (lowest < highest) return {lowest, highest};
    return lowest == 0.0 ? std::pair(-1.0, 1.0) : std::pair(0.9 * lowest, 1.1 * highest);
}

std::string plot_script(const std::filesystem::path& output, const std::string& title,
                        const std::string& x_label, bool from_zero,
                        const std::vector<Series>& series) {
    const auto [lowest, highest] = x_range(series, from_zero);
    std::string script = gnuplot_begin(output, title);
    script += fmt::format(
        "set xlabel {}\nset ylabel 'error (fraction of 1)'\nset logscale y\nset format y '%g'\n"
        "set yrange [{:g}:2]\nset xrange [{:.9g}:{:.9g}]\n"
        "set grid\nset key inside left bottom\n",
        gnuplot_text(x_label), kFloor, lowest, highest);
    for (size_t j = 0; j < series.size(); ++j) {
        script += fmt::format("$data{} << EOD\n", j);
        for (const auto& [x, y] : series[j].points) {
            script += fmt::format("{:.9g} {:.9g}\n", x, std::max(y, kFloor));
        }
        script += "EOD\n";
    }
    script += "plot ";
    for (size_t j = 0; j < series.size(); ++j) {
        script += fmt::format("{}$data{} using 1:2 with {} lw 2 title {}", j > 0 ? ", " : "", j,
                              series[j].measured ? "linespoints pt 7 ps 0.6" : "lines",
                              gnuplot_text(series[j].title));
    }
    return script + "\n";
}

// One value for every setting from 0 on.
Series theory_series(const std::string& title, const std::vector<double>& errors) {
    Series series{title, {}, false};
    for (size_t value = 0; value < errors.size(); ++value) {
        series.points.emplace_back(static_cast<double>(value), errors[value]);
    }
    return series;
}

// The visual errors of all lights against x, where there are any.
std::vector<Series> visual_series(const Curve& curve, const std::vector<NamedLight>& lights,
                                  const std::function<double(const CurvePoint&)>& x) {
    std::vector<Series> all;
    for (size_t light = 0; light < lights.size(); ++light) {
        Series series{"seen, " + lights[light].name, {}};
        for (const CurvePoint& point : curve.points) {
            const double error = point.seen[light].visual_error();
            if (std::isfinite(error)) series.points.emplace_back(x(point), error);
        }
        all.push_back(std::move(series));
    }
    return all;
}

}  // namespace

void write_plots(const std::filesystem::path& directory, const Curve& curve,
                 const std::vector<NamedLight>& lights) {
    const auto draw = [&](const std::string& suffix, const std::string& x_label,
                          std::vector<Series> series, bool from_zero = false) {
        const auto output = directory / (curve.name + suffix + ".svg");
        std::erase_if(series, [](const Series& one) { return one.points.empty(); });
        if (series.empty()) {  // an older one would be shown instead
            std::error_code ignored;
            std::filesystem::remove(output, ignored);
            return;
        }
        run_gnuplot(plot_script(output, curve.title, x_label, from_zero, series), output);
    };
    std::vector<Series> errors{theory_series("theory", curve.theory_errors),
                               theory_series("energy", curve.energy_errors)};
    for (Series& series : visual_series(curve, lights, [](const CurvePoint& point) {
             return static_cast<double>(point.value);
         })) {
        errors.push_back(std::move(series));
    }
    draw("", curve.name == "bands" ? "bands" : "components", errors);
    draw("_bytes", "megabytes of the whole file",
         visual_series(curve, lights, [](const CurvePoint& point) {
             return static_cast<double>(point.size_bytes) / 1e6;
         }));
    draw("_time", "ms to decode a pose",
         visual_series(curve, lights,
                       [](const CurvePoint& point) { return point.decode.median_ms; }),
         true);
}

}  // namespace paim
