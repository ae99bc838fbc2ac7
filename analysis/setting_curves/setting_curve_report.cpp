// Error curves over one setting as charts and sections of the page.
#include "analysis/setting_curves/setting_curve_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "analysis/gnuplot.h"
#include "paim/image/tone.h"

namespace paim {

namespace {

using Line = std::pair<std::string, std::function<double(const Setting&)>>;

// "transfer_error" as "transfer error".
std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

std::vector<Line> lines_of(const SettingCurve& curve, const std::vector<NamedLight>& lights) {
    std::vector<Line> lines;
    for (const std::string& name : curve.drawn) {
        lines.emplace_back(words_of(name),
                           [name](const Setting& setting) { return setting.number(name); });
    }
    for (size_t light = 0; light < lights.size(); ++light) {
        lines.emplace_back("seen, " + lights[light].name, [light](const Setting& setting) {
            return setting.seen[light].visual_error();
        });
    }
    return lines;
}

// The last value of an axis of components is where nothing is lost, and has no logarithm.
bool is_drawn(double error) {
    return std::isfinite(error) && error > 0.0;
}

// Of a column in a table for people: percent, whole numbers, or three digits.
std::string cell_of(const Column& column) {
    if (column.unit == "fraction") {
        const double value = column.value.get<double>();
        return std::isnan(value) ? "unknown" : percent_text(value);
    }
    if (column.value.is_number_float()) {
        return fmt::format("{:.3g}", column.value.get<double>());
    }
    return column.value.dump();
}

PageTable table_of(const SettingCurve& curve, const std::vector<NamedLight>& lights) {
    PageTable table(1);
    table[0].push_back(curve.axis);
    for (const Column& column : curve.settings.front().columns) {
        const bool has_unit = !column.unit.empty() && column.unit != "fraction";
        table[0].push_back(words_of(column.name) + (has_unit ? ", " + column.unit : ""));
    }
    for (const NamedLight& light : lights) {
        table[0].push_back("seen (E6), " + light.name);
        table[0].push_back("least … most");
    }
    for (const Setting& setting : curve.settings) {
        std::vector<std::string>& row = table.emplace_back();
        row.push_back(fmt::format("{}{}", setting.all ? "all: " : "", setting.value));
        for (const Column& column : setting.columns) row.push_back(cell_of(column));
        for (const PictureErrors& seen : setting.seen) {
            const PictureErrors::Spread spread = seen.spread();
            row.push_back(percent_text(seen.visual_error()));
            row.push_back(
                std::isnan(spread.most)
                    ? ""
                    : fmt::format("{:.3g} … {:.3g}", 100.0 * spread.least, 100.0 * spread.most));
        }
    }
    return table;
}

void add_strips(Page& page, const SettingCurve& curve, const NamedLight& light, size_t number) {
    const Image& reference = curve.reference[number];
    const ToneCurve tone{suggested_exposure_ev(reference), 0.0f};
    page.add_paragraph(
        fmt::format("Light: {}, shown at {:+.1f} EV.", light.name, tone.exposure_ev));
    const std::string stem = fmt::format("images/{}_{}", curve.name, number);
    std::vector<Page::Picture> pictures{
        {stem + "_reference.png", curve.reference_name, &reference}};
    std::vector<Page::Picture> differences{{"", "difference, times four", nullptr}};
    std::vector<Image> images;  // that `differences` point to
    images.reserve(curve.settings.size());
    for (const Setting& setting : curve.settings) {
        const std::string file = fmt::format("{}_{}", stem, setting.value);
        pictures.push_back({file + ".png", std::to_string(setting.value), &setting.images[number]});
        images.push_back(difference_image(setting.images[number], reference));
        differences.push_back({file + "_difference.png",
                               "seen: " + percent_text(setting.seen[number].visual_error()),
                               &images.back()});
    }
    page.add_pictures(pictures, tone);
    page.add_pictures(differences, tone);
}

}  // namespace

void write_setting_plot(const std::filesystem::path& directory, const SettingCurve& curve,
                        const std::vector<NamedLight>& lights) {
    const std::filesystem::path output = directory / (curve.name + ".svg");
    std::string data, plots;
    size_t number = 0;
    for (const auto& [title, error_of] : lines_of(curve, lights)) {
        std::string block;
        for (const Setting& setting : curve.settings) {
            const double error = 100.0 * error_of(setting);
            if (is_drawn(error)) block += fmt::format("{} {:.9g}\n", setting.value, error);
        }
        if (block.empty()) continue;
        data += fmt::format("$data{} << EOD\n{}EOD\n", number, block);
        plots += fmt::format("{}$data{} using 1:2 with linespoints pt 7 ps 0.6 lw 2 title {}",
                             number > 0 ? ", " : "plot ", number, gnuplot_text(title));
        ++number;
    }
    if (plots.empty()) {  // an older chart would be shown instead
        std::error_code ignored;
        std::filesystem::remove(output, ignored);
        return;
    }
    run_gnuplot(gnuplot_begin(output, curve.title) +
                    fmt::format("set xlabel {}\nset ylabel 'error, percent'\nset logscale {}\n"
                                "set format '%g'\nset grid\nset key outside right top\n"
                                "set terminal svg size 760,420 noenhanced font 'sans,13' "
                                "background 'white'\n",
                                gnuplot_text(curve.axis), curve.logarithmic ? "xy" : "y") +
                    data + plots + "\n",
                output);
}

void add_setting_curve(Page& page, const SettingCurve& curve, const Stage& stage) {
    page.add_heading(curve.title);
    page.add_paragraph(curve.explanation);
    page.add_plots({curve.name + ".svg"});
    page.add_table(table_of(curve, stage.lights()));
    for (size_t light = 0; light < stage.lights().size(); ++light) {
        add_strips(page, curve, stage.lights()[light], light);
    }
    page.add_link(curve.name + ".csv");
}

}  // namespace paim
