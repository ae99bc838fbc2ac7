// How the tools print their help.
#include "paim/cli/help.h"

#include <algorithm>
#include <utility>

namespace paim::cli {

std::string wrap(const std::string& text, size_t width) {
    std::string wrapped;
    size_t column = 0;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (column > 0 && column + 1 + word.size() > width) {
            wrapped += '\n';
            column = 0;
        }
        if (column > 0) {
            wrapped += ' ';
            ++column;
        }
        wrapped += word;
        const size_t line_end = word.rfind('\n');
        column = line_end == std::string::npos ? column + word.size() : word.size() - line_end - 1;
        begin = end + 1;
    }
    return wrapped;
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name,
                                     CLI::AppFormatMode mode) const {
    std::string help = Formatter::make_help(app, std::move(name), mode);
    while (help.find("\n\n\n") != std::string::npos) {
        help = CLI::detail::find_and_replace(help, "\n\n\n", "\n\n");
    }
    return help;
}

std::string HelpFormatter::make_group(std::string group, bool is_positional,
                                      std::vector<const CLI::Option*> options) const {
    if (group == kHiddenGroup) return {};
    return Formatter::make_group(std::move(group), is_positional, std::move(options));
}

std::string HelpFormatter::make_description(const CLI::App* app) const {
    return Formatter::make_description(app) + "\n";
}

}  // namespace paim::cli
