// Flicker and held-out poses as CSV, JSON, chart and sections of the page.
#include "analysis/temporal/temporal_report.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/csv_field.h"
#include "analysis/gnuplot.h"

namespace paim {

std::string flicker_csv(const std::vector<Flicker>& flickers,
                        const std::vector<NamedLight>& lights) {
    std::string csv = "light,from_pose,to_pose,flicker [fraction of radiance]\n";
    for (size_t light = 0; light < lights.size(); ++light) {
        const std::vector<double>& steps = flickers[light].of_step;
        for (size_t p = 0; p < steps.size(); ++p) {
            csv +=
                fmt::format("{},{},{},{:.9g}\n", csv_field(lights[light].name), p, p + 1, steps[p]);
        }
    }
    return csv;
}

nlohmann::ordered_json flicker_json(const std::vector<Flicker>& flickers,
                                    const std::vector<NamedLight>& lights) {
    nlohmann::ordered_json json;
    for (size_t light = 0; light < lights.size(); ++light) {
        const Flicker& flicker = flickers[light];
        json[lights[light].name] = {{"of_change", flicker.of_change()},
                                    {"of_radiance", flicker.of_radiance()},
                                    {"noise_of_change", flicker.noise_of_change()},
                                    {"worst_step", flicker.worst_step},
                                    {"of_step", flicker.of_step}};
    }
    return json;
}

void write_flicker_plot(const std::filesystem::path& output, const std::vector<Flicker>& flickers,
                        const std::vector<NamedLight>& lights) {
    std::string script = gnuplot_begin(output, "Flicker");
    script +=
        "set xlabel 'pose'\nset ylabel 'error of the change, percent of radiance'\n"
        "set grid\nset key outside right top\n";
    double most = 0.0;
    for (const Flicker& flicker : flickers) {
        for (const double step : flicker.of_step) most = std::fmax(most, step);
    }
    // A single step, or no flicker at all, is no range.
    script += fmt::format("set xrange [0:{}]\nset yrange [0:{}]\n", flickers.front().of_step.size(),
                          most > 0.0 ? "*" : "1");
    std::string plots;
    for (size_t light = 0; light < lights.size(); ++light) {
        script += fmt::format("$data{} << EOD\n", light);
        const std::vector<double>& steps = flickers[light].of_step;
        for (size_t p = 0; p < steps.size(); ++p) {
            script += fmt::format("{} {:.9g}\n", static_cast<double>(p) + 0.5, 100.0 * steps[p]);
        }
        script += "EOD\n";
        plots += fmt::format("{}$data{} using 1:2 with linespoints pt 7 ps 0.4 title {}",
                             light > 0 ? ", " : "", light, gnuplot_text(lights[light].name));
    }
    run_gnuplot(script + "plot " + plots + "\n", output);
}

void add_flicker(Page& page, const std::string& file, const std::vector<Flicker>& flickers,
                 const std::vector<NamedLight>& lights) {
    page.add_heading("Flicker of " + file);
    page.add_paragraph(
        "The error of the change of radiance from one pose to the next, over all vertices: relative "
        "to the change as baked, and relative to the radiance. The noise of the bake changes from pose to "
        "pose, too: a file without it differs from the bake by as much.");
    page.add_plots({"flicker.svg"});
    PageTable table(1);
    table[0] = {"light",           "of the change", "of it, noise of the bake",
                "of the radiance", "worst step",    "of the radiance in that step"};
    for (size_t light = 0; light < lights.size(); ++light) {
        const Flicker& flicker = flickers[light];
        const uint32_t p = flicker.worst_step;
        table.push_back({lights[light].name, percent_text(flicker.of_change()),
                         percent_text(flicker.noise_of_change()),
                         percent_text(flicker.of_radiance()), fmt::format("{} to {}", p, p + 1),
                         percent_text(flicker.of_step[p])});
    }
    page.add_table(table);
    page.add_link("flicker.csv");
}

std::string held_out_csv(const HeldOut& held_out, const std::vector<NamedLight>& lights) {
    std::string csv =
        "light,poses,visual_error [fraction],visual_error_most [fraction],psnr [dB],"
        "position_rms [scene units],position_worst [scene units],worst_vertex,worst_pose,"
        "transfer_error [fraction]\n";
    const auto add_line = [&](size_t light, const char* poses, const InBetweenError& error) {
        const PictureErrors& seen = error.seen[light];
        csv += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{},{:.9g}\n",
                           csv_field(lights[light].name), poses, seen.visual_error(),
                           seen.spread().most, seen.all().psnr_db(), error.distance.rms(),
                           error.distance.worst, error.distance.worst_vertex,
                           error.distance.worst_pose, error.transfer.relative());
    };
    for (size_t light = 0; light < lights.size(); ++light) {
        add_line(light, "encoded", held_out.encoded);
        add_line(light, "interpolated", held_out.interpolated);
    }
    return csv;
}

nlohmann::ordered_json held_out_json(const HeldOut& held_out,
                                     const std::vector<NamedLight>& lights) {
    nlohmann::ordered_json json;
    json["target"] = held_out.target;
    json["kept_poses"] = held_out.num_kept;
    json["measured_poses"] = held_out.num_measured;
    const auto add = [&](const char* name, const InBetweenError& error) {
        nlohmann::ordered_json& entry = json[name];
        entry["position_rms"] = error.distance.rms();
        entry["position_worst"] = {{"distance", error.distance.worst},
                                   {"vertex", error.distance.worst_vertex},
                                   {"pose", error.distance.worst_pose}};
        entry["transfer_error"] = error.transfer.relative();
        for (size_t light = 0; light < lights.size(); ++light) {
            const PictureErrors& seen = error.seen[light];
            entry["visual_error"][lights[light].name] = seen.visual_error();
            entry["visual_error_most"][lights[light].name] = seen.spread().most;
            entry["psnr_db"][lights[light].name] = seen.all().psnr_db();
        }
    };
    add("encoded", held_out.encoded);
    add("interpolated", held_out.interpolated);
    return json;
}

void add_held_out(Page& page, const HeldOut& held_out, const std::vector<NamedLight>& lights) {
    page.add_heading("Held-out poses");
    page.add_paragraph(fmt::format(
        "Every other pose was encoded to an error of {}, {} poses. The {} poses between them are "
        "compared with their own bakes: decoded at half times, and interpolated between baked poses "
        "without encoding, which is what the distance of the poses costs.",
        percent_text(held_out.target), held_out.num_kept, held_out.num_measured));
    PageTable table(1);
    table[0] = {"in-between poses"};
    for (const NamedLight& light : lights) {
        table[0].push_back("seen (E6), " + light.name);
        table[0].emplace_back("most");
    }
    for (const char* const heading : {"positions, RMS", "worst (vertex, pose)", "transfer"}) {
        table[0].emplace_back(heading);
    }
    const auto add_row = [&](const char* name, const InBetweenError& error) {
        std::vector<std::string> row{name};
        for (const PictureErrors& seen : error.seen) {
            row.push_back(percent_text(seen.visual_error()));
            row.push_back(percent_text(seen.spread().most));
        }
        row.push_back(fmt::format("{:.3g}", error.distance.rms()));
        row.push_back(fmt::format("{:.3g} ({}, {})", error.distance.worst,
                                  error.distance.worst_vertex, error.distance.worst_pose));
        row.push_back(percent_text(error.transfer.relative()));
        table.push_back(std::move(row));
    };
    add_row("decoded from the file", held_out.encoded);
    add_row("interpolated from the bake, not encoded", held_out.interpolated);
    page.add_table(table);
    page.add_link("held_out.csv");
}

}  // namespace paim
