// One HTML page of results, which needs no network.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "paim/image/image.h"
#include "paim/image/tone.h"

namespace paim {

// Text inside of HTML.
std::string escape_html(const std::string& text);

// Rows of cells, the first one of headings. All cells are text.
using PageTable = std::vector<std::vector<std::string>>;

// Percent with three digits: "1.23 %"; "nothing to see" for what is not a number.
std::string percent_text(double fraction);

// |image − reference|, times four.
Image difference_image(const Image& image, const Image& reference);

class Page {
  public:
    // directory  of index.html, and of all files that the page shows
    Page(std::filesystem::path directory, std::string title, const std::string& summary);

    const std::filesystem::path& directory() const { return directory_; }

    void add_heading(const std::string& text);
    void add_paragraph(const std::string& text);
    // Of terms, each with what it means.
    void add_glossary(const std::vector<std::pair<std::string, std::string>>& terms);
    // Lines as they are, in a font of equal widths.
    void add_code(const std::string& text);
    void add_table(const PageTable& table);
    // Those of the SVG files that are in the directory.
    void add_plots(const std::vector<std::string>& files);
    void add_link(const std::string& file);

    struct Picture {
        std::string file;  // in the directory, ends in .png
        std::string caption;
        const Image* image;  // nullptr: the caption stands alone
    };
    // Pictures side by side, which are written. Error: output failed.
    void add_pictures(const std::vector<Picture>& pictures, const ToneCurve& tone);

    // Writes index.html. Error: output failed.
    void write() const;

  private:
    std::filesystem::path directory_;
    std::string html_;
};

}  // namespace paim
