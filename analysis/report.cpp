// The sections of error curves on the page of results.
#include "analysis/report.h"

#include <fmt/format.h>

#include <cmath>

namespace paim {

namespace {

std::string label(const Curve& curve, const CurvePoint& point) {
    return fmt::format("{}{}{}", point.all ? "all: " : "", point.value,
                       curve.name == "bands" ? " bands" : " components");
}

void add_strips(Page& page, const Curve& curve, const Stage& stage,
                const std::vector<Image>& references, const std::string& reference_name) {
    for (size_t light = 0; light < stage.lights().size(); ++light) {
        const Image& reference = references[light];
        const ToneCurve tone{suggested_exposure_ev(reference), 0.0f};
        const NamedLight& named = stage.lights()[light];
        std::string text =
            fmt::format("Light: {}, shown at {:+.1f} EV.", named.name, tone.exposure_ev);
        if (std::isnan(curve.points.front().seen[light].visual_error())) {
            text += " Nothing to see: " + why_nothing_is_seen(named) + ".";
        }
        page.add_paragraph(text);
        const std::string of_reference = fmt::format("images/reference_{}.png", light);
        std::vector<Page::Picture> pictures{{of_reference, reference_name, &reference}};
        std::vector<Page::Picture> differences{{"", "difference, times four", nullptr}};
        std::vector<Image> images;  // that `differences` point to
        images.reserve(curve.points.size());
        for (const CurvePoint& point : curve.points) {
            const std::string stem = fmt::format("images/{}_{}_{}", curve.name, light, point.value);
            pictures.push_back({stem + ".png", label(curve, point), &point.images[light]});
            images.push_back(difference_image(point.images[light], reference));
            differences.push_back({stem + "_difference.png",
                                   "seen: " + percent_text(point.seen[light].visual_error()),
                                   &images.back()});
        }
        page.add_pictures(pictures, tone);
        page.add_pictures(differences, tone);
    }
}

PageTable table_of(const Curve& curve, const Stage& stage) {
    PageTable table(1);
    table[0] = {"kept", "theory (E5)", "energy"};
    for (const NamedLight& light : stage.lights()) {
        table[0].push_back("seen (E6), " + light.name);
        table[0].push_back("least … most");
        table[0].push_back("PSNR");
    }
    for (const char* const heading : {"positions, RMS", "worst (vertex, pose)", "edges", "normals",
                                      "transfer", "bytes", "decode, ms"}) {
        table[0].emplace_back(heading);
    }
    for (const CurvePoint& point : curve.points) {
        std::vector<std::string> row{label(curve, point), percent_text(point.theory_error),
                                     percent_text(point.energy_error)};
        for (const PictureErrors& seen : point.seen) {
            const PictureErrors::Spread spread = seen.spread();
            row.push_back(percent_text(seen.visual_error()));
            row.push_back(
                std::isnan(spread.most)
                    ? ""
                    : fmt::format("{:.3g} … {:.3g}", 100.0 * spread.least, 100.0 * spread.most));
            row.push_back(fmt::format("{:.1f} dB", seen.all().psnr_db()));
        }
        row.push_back(fmt::format("{:.3g}", point.distance.rms()));
        row.push_back(fmt::format("{:.3g} ({}, {})", point.distance.worst,
                                  point.distance.worst_vertex, point.distance.worst_pose));
        row.push_back(percent_text(point.shape.sted_space));
        row.push_back(fmt::format("{:.3g}°", point.shape.normal_angle_deg));
        row.push_back(percent_text(point.transfer.relative()));
        row.push_back(fmt::format("{}", point.size_bytes));
        row.push_back(fmt::format("{:.3g}", point.decode.median_ms));
        table.push_back(std::move(row));
    }
    return table;
}

}  // namespace

void add_curves(Page& page, const std::vector<Curve>& curves, const Stage& stage,
                const std::vector<Image>& references, const std::string& reference_name) {
    for (const Curve& curve : curves) {
        page.add_heading(curve.title);
        page.add_plots({curve.name + ".svg", curve.name + "_bytes.svg", curve.name + "_time.svg"});
        page.add_table(table_of(curve, stage));
        add_strips(page, curve, stage, references, reference_name);
        page.add_link(curve.name + ".csv");
    }
}

}  // namespace paim
