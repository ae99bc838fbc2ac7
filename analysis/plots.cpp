// Error curves as SVG, drawn by gnuplot.
#include "analysis/plots.h"

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "paim/base/error.h"
#include "paim/base/file.h"

namespace paim {

namespace {

// Zero has no place on a logarithmic axis; what is exact is drawn at this floor.
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

// Text within gnuplot's single quotes.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

struct Series {
    std::string title;
    std::vector<std::pair<double, double>> points;
};

// gnuplot warns about axes on which all values are one; they get a range round it.
std::string axis_ranges(const std::vector<Series>& series) {
    double least_x = std::numeric_limits<double>::infinity();
    double greatest_x = -least_x;
    double greatest_y = kFloor;
    for (const Series& one : series) {
        for (const auto& [x, y] : one.points) {
            least_x = std::min(least_x, x);
            greatest_x = std::max(greatest_x, x);
            greatest_y = std::max(greatest_y, y);
        }
    }
    std::string ranges = fmt::format("set yrange [{:g}:{}]\n", kFloor,
                                     greatest_y > kFloor ? "*" : fmt::format("{:g}", 10 * kFloor));
    if (least_x == greatest_x) {
        const double margin = least_x == 0.0 ? 1.0 : 0.5 * std::abs(least_x);
        ranges += fmt::format("set xrange [{:.9g}:{:.9g}]\n", least_x - margin, least_x + margin);
    }
    return ranges;
}

std::string plot_script(const std::filesystem::path& output, const std::string& title,
                        const std::string& x_label, bool log_x, const std::vector<Series>& series) {
    std::string script = fmt::format(
        "set terminal svg size 640,420 noenhanced font 'sans,13' background 'white'\n"
        "set output {}\nset title {} noenhanced\nset xlabel {}\nset ylabel 'error (fraction)'\n"
        "set logscale y\nset format y '10^{{%L}}'\nset grid\nset key below horizontal\n{}{}",
        quoted(output.string()), quoted(title), quoted(x_label), axis_ranges(series),
        log_x ? "set logscale x\n" : "");
    for (size_t j = 0; j < series.size(); ++j) {
        script += fmt::format("$data{} << EOD\n", j);
        for (const auto& [x, y] : series[j].points) {
            script += fmt::format("{:.9g} {:.9g}\n", x, std::max(y, kFloor));
        }
        script += "EOD\n";
    }
    script += "plot ";
    for (size_t j = 0; j < series.size(); ++j) {
        script += fmt::format("{}$data{} using 1:2 with linespoints lw 2 pt 7 ps 0.6 title {}",
                              j > 0 ? ", " : "", j, quoted(series[j].title));
    }
    return script + "\n";
}

Series make_series(const std::string& title, const Curve& curve,
                   const std::function<double(const CurvePoint&)>& x,
                   const std::function<double(const CurvePoint&)>& y) {
    Series series{title, {}};
    for (const CurvePoint& point : curve.points) series.points.emplace_back(x(point), y(point));
    return series;
}

}  // namespace

bool have_gnuplot() { return std::system("gnuplot --version > /dev/null 2>&1") == 0; }

void write_plots(const std::filesystem::path& directory, const Curve& curve,
                 const std::vector<NamedLight>& lights) {
    const auto value = [](const CurvePoint& point) { return static_cast<double>(point.value); };
    const auto visual_series = [&](const std::function<double(const CurvePoint&)>& x) {
        std::vector<Series> series;
        for (size_t light = 0; light < lights.size(); ++light) {
            series.push_back(make_series(
                "seen, " + lights[light].name, curve, x,
                [light](const CurvePoint& point) { return point.visual_error[light]; }));
        }
        return series;
    };
    std::vector<Series> errors = visual_series(value);
    errors.insert(errors.begin(), {make_series("theory", curve, value,
                                               [](const CurvePoint& p) { return p.theory_error; }),
                                   make_series("energy", curve, value,
                                               [](const CurvePoint& p) { return p.energy_error; })});
    const auto draw = [&](const std::string& suffix, const std::string& x_label, bool log_x,
                          const std::vector<Series>& series) {
        const auto output = directory / (curve.name + suffix + ".svg");
        run_gnuplot(plot_script(output, curve.title, x_label, log_x, series), output);
    };
    draw("", curve.name == "bands" ? "bands" : "components", false, errors);
    draw("_bytes", "bytes", true,
         visual_series([](const CurvePoint& p) { return static_cast<double>(p.size_bytes); }));
    draw("_time", "ms to decode a pose", true,
         visual_series([](const CurvePoint& p) { return p.decode_ms; }));
}

}  // namespace paim
