// How the tools print their help: descriptions wrapped to the right of the options' names.
#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace paim::cli {

// Lines of the help are at most this long, unless a single word is longer.
constexpr size_t kHelpWidth = 100;

// Options of this group work and are not shown. CLI11 hides those of the group "", but then leaves
// their names out of messages.
constexpr const char* kHiddenGroup = "Hidden";

// The text with line breaks instead of some spaces, so that lines have at most `width` characters.
std::string wrap(const std::string& text, size_t width);

// CLI11's form of the help with wrapped descriptions and one blank line between its parts.
class HelpFormatter : public CLI::Formatter {
  public:
    std::string make_help(const CLI::App* app, std::string name,
                          CLI::AppFormatMode mode) const override;
    std::string make_group(std::string group, bool is_positional,
                           std::vector<const CLI::Option*> options) const override;
    std::string make_description(const CLI::App* app) const override;
    std::string make_option_desc(const CLI::Option* option) const override {
        return wrap(option->get_description(), kHelpWidth - get_column_width());
    }
};

}  // namespace paim::cli
