// One HTML page of results.
#include "analysis/page.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "paim/base/file.h"
#include "paim/image/png.h"

namespace paim {

namespace {

constexpr float kDifferenceGain = 4.0f;

// Bytes of a cell from which on it is a sentence.
constexpr size_t kLongCell = 20;

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:78em;padding:0 "
    "1em;color:#222}"
    "h1,h2{font-weight:600}table{border-collapse:collapse;margin:1em 0}"
    ".wide{overflow-x:auto}dt{font-weight:600;float:left;margin-right:.5em}dd{margin:0 0 .2em 0}"
    "th,td{padding:.2em .55em;font-size:14px;text-align:right;border-bottom:1px solid #ddd}"
    "td{white-space:nowrap}td.text{white-space:normal;text-align:left;min-width:16em}td:first-child,th:first-child{text-align:left}"
    ".strip{display:flex;gap:6px;overflow-x:auto;margin:.5em 0}.strip figure{margin:0;flex-shrink:0}pre{overflow-x:auto;background:#f4f4f4;padding:.6em}"
    ".strip img{width:136px;height:136px;display:block;background:#000}"
    ".none{width:136px}"
    "figcaption{font-size:13px;text-align:center;color:#555;max-width:136px}"
    ".plots{display:flex;flex-wrap:wrap;gap:8px}.plots img{width:49%;min-width:520px}";

}  // namespace

std::string escape_html(const std::string& text) {
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

std::string percent_text(double fraction) {
    return std::isnan(fraction) ? "nothing to see" : fmt::format("{:.3g} %", 100.0 * fraction);
}

Image difference_image(const Image& image, const Image& reference) {
    Image result(image.width, image.height);
    for (size_t j = 0; j < image.pixels.size(); ++j) {
        result.pixels[j] = kDifferenceGain * (image.pixels[j] - reference.pixels[j]).cwiseAbs();
    }
    return result;
}

Page::Page(std::filesystem::path directory, std::string title, const std::string& summary)
    : directory_(std::move(directory)) {
    title = escape_html(title);
    html_ = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>"
        "<style>{1}</style></head><body>\n<h1>{0}</h1>\n<p>{2}</p>\n",
        title, kStyle, escape_html(summary));
}

void Page::add_heading(const std::string& text) {
    html_ += "<h2>" + escape_html(text) + "</h2>\n";
}

void Page::add_paragraph(const std::string& text) {
    html_ += "<p>" + escape_html(text) + "</p>\n";
}

void Page::add_glossary(const std::vector<std::pair<std::string, std::string>>& terms) {
    html_ += "<dl>";
    for (const auto& [term, meaning] : terms) {
        html_ += "<dt>" + escape_html(term) + "</dt><dd>" + escape_html(meaning) + "</dd>\n";
    }
    html_ += "</dl>\n";
}

void Page::add_code(const std::string& text) {
    html_ += "<pre>" + escape_html(text) + "</pre>\n";
}

void Page::add_table(const PageTable& table) {
    html_ += "<div class=\"wide\"><table>";
    for (size_t row = 0; row < table.size(); ++row) {
        const char* const tag = row == 0 ? "th" : "td";
        html_ += "<tr>";
        for (const std::string& cell : table[row]) {
            // Sentences may have several lines, numbers may not.
            const char* const style = cell.size() > kLongCell ? " class=\"text\"" : "";
            html_ += fmt::format("<{0}{2}>{1}</{0}>", tag, escape_html(cell), style);
        }
        html_ += "</tr>\n";
    }
    html_ += "</table></div>\n";
}

void Page::add_plots(const std::vector<std::string>& files) {
    html_ += "<div class=\"plots\">";
    for (const std::string& file : files) {
        if (!std::filesystem::exists(directory_ / file)) continue;
        html_ += fmt::format("<img src=\"{0}\" alt=\"{0}\">", escape_html(file));
    }
    html_ += "</div>\n";
}

void Page::add_link(const std::string& file) {
    html_ += fmt::format("<p><a href=\"{0}\">{0}</a></p>\n", escape_html(file));
}

void Page::add_pictures(const std::vector<Picture>& pictures, const ToneCurve& tone) {
    html_ += "<div class=\"strip\">";
    for (const Picture& picture : pictures) {
        if (picture.image == nullptr) {
            html_ += "<figure class=\"none\"><figcaption>" + escape_html(picture.caption) +
                     "</figcaption></figure>";
            continue;
        }
        ensure_directory((directory_ / picture.file).parent_path());
        write_png(directory_ / picture.file, *picture.image, tone);
        html_ += fmt::format(
            "<figure><img src=\"{0}\" alt=\"{1}\"><figcaption>{1}</figcaption></figure>",
            escape_html(picture.file), escape_html(picture.caption));
    }
    html_ += "</div>\n";
}

void Page::write() const {
    write_file(directory_ / "index.html", html_ + "</body></html>\n");
}

}  // namespace paim
