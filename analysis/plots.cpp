// Error curves as SVG, drawn by gnuplot.
#include "analysis/plots.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "paim/base/error.h"
#include "paim/base/file.h"

namespace paim {

namespace {

// Errors of 0 are drawn at this value of the logarithmic axis.
constexpr double kFloor = 1e-7;

// Runs a gnuplot script given on its standard input.
void run_gnuplot(const std::string& script, const std::filesystem::path& output) {
    std::FILE* pipe = ::popen("gnuplot", "w");
    if (pipe == nullptr) throw_output_failed("{}: cannot start gnuplot", output.string());
    const bool written = std::fwrite(script.data(), 1, script.size(), pipe) == script.size();
    const int status = ::pclose(pipe);
    if (!written || status != 0 || !std::filesystem::exists(output)) {
        throw_output_failed("{}: gnuplot failed (status {})", output.string(), status);
    }
}

// Text in gnuplot's single quotes. Control characters, which file names may have, become blanks: a
// line feed would end the string, and gnuplot would run the text after it as a command.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'') result += '\'';
        result += std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
    }
    return result + "'";
}

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
    std::string script = fmt::format(
        "set terminal svg size 640,420 noenhanced font 'sans,13' background 'white'\n"
        "set output {}\nset title {} noenhanced\nset xlabel {}\n"
        "set ylabel 'error (fraction of 1)'\nset logscale y\nset format y '%g'\n"
        "set yrange [{:g}:2]\nset xrange [{:.9g}:{:.9g}]\n"
        "set grid\nset key inside left bottom\n",
        quoted(output.string()), quoted(title), quoted(x_label), kFloor, lowest, highest);
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
                              quoted(series[j].title));
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
            const double error = point.visual_error[light];
            if (std::isfinite(error)) series.points.emplace_back(x(point), error);
        }
        all.push_back(std::move(series));
    }
    return all;
}

}  // namespace

bool have_gnuplot() {
    return std::system("gnuplot --version > /dev/null 2>&1") == 0;
}

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
         visual_series(curve, lights, [](const CurvePoint& point) { return point.decode_ms; }),
         true);
}

}  // namespace paim
