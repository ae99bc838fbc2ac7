// The HTML page with curves, tables and images.
#include "analysis/report.h"

#include <fmt/format.h>

#include <cmath>

#include "paim/base/file.h"
#include "paim/image/png.h"

namespace paim {

namespace {

constexpr float kDifferenceGain = 4.0f;

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:78em;padding:0 "
    "1em;color:#222}"
    "h1,h2{font-weight:600}table{border-collapse:collapse;margin:1em 0}"
    "th,td{padding:.25em .8em;text-align:right;border-bottom:1px solid #ddd}"
    ".strip{display:flex;gap:6px;overflow-x:auto;margin:.5em 0}.strip figure{margin:0}"
    ".strip img{width:180px;height:180px;display:block;background:#000}"
    "figcaption{font-size:13px;text-align:center;color:#555}"
    ".plots{display:flex;flex-wrap:wrap;gap:8px}.plots img{width:32%;min-width:320px}";

std::string escape(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

Image difference(const Image& image, const Image& reference) {
    Image result(image.width, image.height);
    for (size_t j = 0; j < image.pixels.size(); ++j) {
        result.pixels[j] = kDifferenceGain * (image.pixels[j] - reference.pixels[j]).cwiseAbs();
    }
    return result;
}

std::string visual_text(double error) {
    return std::isnan(error) ? "nothing to see" : fmt::format("{:.3g} %", 100.0 * error);
}

std::string label(const Curve& curve, const CurvePoint& point) {
    return fmt::format("{}{}{}", point.all ? "all: " : "", point.value,
                       curve.name == "bands" ? " bands" : " components");
}

// Writes one image and returns its figure element.
std::string figure(const std::filesystem::path& directory, const std::string& file,
                   const std::string& caption, const Image& image, const ToneCurve& curve) {
    write_png(directory / file, image, curve);
    return fmt::format("<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>",
                       escape(file), escape(caption));
}

std::string strips(const std::filesystem::path& directory, const Curve& curve, const Stage& stage,
                   const std::vector<Image>& references) {
    std::string html;
    for (size_t light = 0; light < stage.lights().size(); ++light) {
        const Image& reference = references[light];
        const ToneCurve tone{suggested_exposure_ev(reference), 0.0f};
        const NamedLight& named = stage.lights()[light];
        html +=
            fmt::format("<p>Light: {}, shown at {:+.1f} EV", escape(named.name), tone.exposure_ev);
        if (std::isnan(curve.points.front().visual_error[light])) {
            html += ". Nothing to see: " + escape(why_nothing_is_seen(named));
        }
        html += "</p>\n<div class=\"strip\">";
        html += figure(directory, fmt::format("images/baked_{}.png", light), "as baked", reference,
                       tone);
        std::string differences;
        for (const CurvePoint& point : curve.points) {
            const std::string stem = fmt::format("images/{}_{}_{}", curve.name, light, point.value);
            const Image& image = point.images[light];
            html += figure(directory, stem + ".png", label(curve, point), image, tone);
            differences += figure(directory, stem + "_difference.png",
                                  "seen: " + visual_text(point.visual_error[light]),
                                  difference(image, reference), tone);
        }
        html +=
            "</div>\n<div class=\"strip\"><figure style=\"width:180px\"><figcaption>difference "
            "from the bake, times four</figcaption></figure>" +
            differences + "</div>\n";
    }
    return html;
}

std::string table(const Curve& curve, const Stage& stage) {
    std::string html = "<table><tr><th>kept</th><th>theory (E5)</th><th>energy</th>";
    for (const NamedLight& light : stage.lights()) {
        html += fmt::format("<th>seen (E6), {}</th>", escape(light.name));
    }
    html +=
        "<th>positions, RMS</th><th>worst (vertex, "
        "pose)</th><th>transfer</th><th>bytes</th><th>decode, ms</th></tr>\n";
    for (const CurvePoint& point : curve.points) {
        html +=
            fmt::format("<tr><td>{}</td><td>{:.3g} %</td><td>{:.3g} %</td>", label(curve, point),
                        100.0 * point.theory_error, 100.0 * point.energy_error);
        for (const double error : point.visual_error) {
            html += "<td>" + visual_text(error) + "</td>";
        }
        html += fmt::format(
            "<td>{:.3g}</td><td>{:.3g} ({}, {})</td><td>{:.3g} "
            "%</td><td>{}</td><td>{:.3g}</td></tr>\n",
            point.distance.rms(), point.distance.worst, point.distance.worst_vertex,
            point.distance.worst_pose, 100.0 * point.transfer.relative(), point.size_bytes,
            point.decode_ms);
    }
    return html + "</table>\n";
}

}  // namespace

void write_report(const std::filesystem::path& directory, const std::string& title,
                  const std::string& summary, const std::vector<Curve>& curves, const Stage& stage,
                  const std::vector<Image>& references, bool with_plots) {
    ensure_directory(directory / "images");
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
        "<style>{1}</style></head><body>\n<h1>{0}</h1>\n<p>{2}</p>\n",
        escape(title), kStyle, escape(summary));
    html +=
        "<p><b>theory</b>: share of the singular values that is dropped (E5). <b>energy</b>: its "
        "root-mean-square form, the relative error of what moves. <b>seen</b>: difference of "
        "rendered "
        "images relative to the bake's (E6). <b>positions</b>: distance from the bake's, in scene "
        "units. <b>transfer</b>: relative error of the transfer itself. <b>decode</b>: median time "
        "to "
        "rebuild a pose on this machine, rough. docs/metrics.md defines them.</p>\n";
    for (const Curve& curve : curves) {
        html += fmt::format("<h2>{}</h2>\n", escape(curve.title));
        if (with_plots) {
            html += "<div class=\"plots\">";
            for (const char* suffix : {"", "_bytes", "_time"}) {
                if (!std::filesystem::exists(directory / (curve.name + suffix + ".svg"))) continue;
                html += fmt::format("<img src=\"{0}{1}.svg\" alt=\"{0}{1}\">", curve.name, suffix);
            }
            html += "</div>\n";
        }
        html += table(curve, stage) + strips(directory, curve, stage, references) +
                fmt::format("<p><a href=\"{0}.csv\">{0}.csv</a></p>\n", curve.name);
    }
    html += "</body></html>\n";
    write_file(directory / "index.html", html);
}

}  // namespace paim
