// Lists of numbers on the command line.
#include "player/option_group.h"

#include <charconv>
#include <system_error>

namespace paim::player {

std::vector<double> parse_numbers(const char* option, const std::string& text, size_t least,
                                  size_t most, const char* expected) {
    std::vector<double> values;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (values.size() < most) {
        double value = 0.0;
        const auto [rest, failure] = std::from_chars(at, end, value);
        if (failure != std::errc()) break;
        values.push_back(value);
        at = rest;
        if (at == end || *at != ',' || at + 1 == end) break;
        ++at;
    }
    if (at != end || values.size() < least) {
        throw_usage("{}: expected {}, got '{}'", option, expected, text);
    }
    return values;
}

}  // namespace paim::player
