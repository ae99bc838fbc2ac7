// Command-line parsing shared by the tools: CLI11 with Paim's exit codes and value forms.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "paim/base/vector.h"

namespace paim::cli {

// Parses argv. Prints help (help.h) or the version and returns 0, or prints what is wrong and
// returns ExitCode::usage; returns -1 when the tool should go on.
int parse(CLI::App& app, int argc, const char* const* argv);

// A check for options: a whole number (or, for floating-point T, a finite one) from lowest to
// highest. What it says is what every other message says; the range is in the option's own
// description.
template <typename T>
CLI::Validator in_range(T lowest, T highest) {
    const auto check = [lowest, highest](std::string& text) {
        T value{};
        const char* end = text.data() + text.size();
        const auto [rest, failure] = std::from_chars(text.data(), end, value);
        // Written so that NaN fails it.
        if (failure == std::errc() && rest == end && value >= lowest && value <= highest) {
            return std::string();
        }
        return fmt::format("expected {} to {}, got '{}'", lowest, highest, text);
    };
    return CLI::Validator(check, "");
}

// A check for options: one of the names.
CLI::Validator one_of(std::vector<std::string> names);

// How the help shows an option with these names and a current one.
std::string choice_text(const std::vector<std::string>& names, const std::string& current);

// Adds an option that takes one of the names, and shows them with the current value in the help.
CLI::Option* add_choice(CLI::App& app, const std::string& option, std::string& value,
                        const std::vector<std::string>& names, const std::string& help);

// The same for an enum: `value` becomes the choice of the name.
template <typename Value>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Value& value,
                        const std::vector<std::pair<std::string, Value>>& choices,
                        const std::string& help) {
    std::vector<std::string> names;
    std::string current;
    for (const auto& [name, choice] : choices) {
        names.push_back(name);
        if (choice == value) current = name;
    }
    return app.add_option(option, value, help)
        ->transform(CLI::CheckedTransformer(choices).description(""))
        // In front of the other, whose messages list numbers and which takes them, too.
        ->transform(one_of(names))
        ->option_text(choice_text(names, current));
}

// "0.05" or "5%" as 0.05. Throws Error(usage) naming the option unless it is a finite number >= 0.
double parse_fraction(const std::string& text, const std::string& option);

// The same for a share: more than 0 and less than 1.
double parse_share(const std::string& text, const std::string& option);

// "1000000", "512M", "1.5G" in bytes: K, M, G and T (or k, m, g, t) are powers of 1000. Throws
// Error(usage) naming the option unless it is a number from 1 byte to 2^63 bytes; fractions of a
// byte are dropped.
uint64_t parse_bytes(const std::string& text, const std::string& option);

// "20,7,4" as numbers, each lowest … highest and a multiple of `step`, which is 1 or 2. Throws Error(usage)
// naming the option.
std::vector<uint32_t> parse_list(const std::string& text, const std::string& option,
                                 uint32_t lowest, uint32_t highest, uint32_t step = 1);

// "R,G,B" or one number for all three, each in [0, 1]. Throws Error(usage) naming the option.
Vec3f parse_color(const std::string& text, const std::string& option);

// "WxH" in pixels, each 1..16384. Throws Error(usage) naming the option.
std::pair<int, int> parse_size(const std::string& text, const std::string& option);

// The version line that `TOOL --version` prints.
std::string version_text(const std::string& tool);

}  // namespace paim::cli
