// Parsing of values that several tools take.
#include "paim/cli/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <system_error>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/version.h"
#include "paim/cli/help.h"

namespace paim::cli {

namespace {

// The whole text as a finite number, or false.
bool parse_number(std::string_view text, double& value) {
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failure == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

int parse(CLI::App& app, int argc, const char* const* argv) {
    const auto formatter = std::make_shared<HelpFormatter>();
    app.formatter(formatter);
    for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
        command->formatter(formatter);
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& success) {  // --help, --version
        return app.exit(success);
    } catch (const CLI::ExtrasError&) {
        // The first of them that looks like an option is the mistake; what follows may be its
        // value.
        const std::vector<std::string> extras = app.remaining(true);
        const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& text) {
            return text.starts_with('-');
        });
        const bool found = option != extras.end();
        throw_usage("unknown {} '{}'; see --help", found ? "option" : "argument",
                    found ? *option : extras.front());
    } catch (const CLI::ParseError& error) {
        app.exit(error);
        return static_cast<int>(ExitCode::usage);
    }
    return -1;
}

CLI::Validator one_of(std::vector<std::string> names) {
    const auto check = [names = std::move(names)](std::string& text) -> std::string {
        if (std::find(names.begin(), names.end(), text) != names.end()) return {};
        return fmt::format("expected one of {}, got '{}'", fmt::join(names, ", "), text);
    };
    return CLI::Validator(check, "");
}

std::string choice_text(const std::vector<std::string>& names, const std::string& current) {
    return fmt::format("{{{}}}={}", fmt::join(names, ","), current);
}

CLI::Option* add_choice(CLI::App& app, const std::string& option, std::string& value,
                        const std::vector<std::string>& names, const std::string& help) {
    return app.add_option(option, value, help)
        ->check(one_of(names))
        ->option_text(choice_text(names, value));
}

double parse_fraction(const std::string& text, const std::string& option) {
    std::string_view number = text;
    const bool percent = number.ends_with('%');
    if (percent) number.remove_suffix(1);
    double value = 0.0;
    if (!parse_number(number, value) || value < 0.0) {
        throw_usage("{}: expected a fraction such as 0.05 or 5%, got '{}'", option, text);
    }
    return percent ? value / 100.0 : value;
}

double parse_share(const std::string& text, const std::string& option) {
    const double value = parse_fraction(text, option);
    if (!(value > 0.0 && value < 1.0)) {
        throw_usage("{}: expected more than 0 and less than 1 (or 100%), got '{}'", option, text);
    }
    return value;
}

uint64_t parse_bytes(const std::string& text, const std::string& option) {
    constexpr std::string_view kUnits = "KMGT";
    std::string_view number = text;
    double unit = 1.0;
    if (!number.empty()) {
        const char letter =
            static_cast<char>(std::toupper(static_cast<unsigned char>(text.back())));
        const size_t power = kUnits.find(letter);
        if (power != std::string_view::npos) {
            unit = std::pow(1000.0, static_cast<double>(power + 1));
            number.remove_suffix(1);
        }
    }
    double value = 0.0;
    if (!parse_number(number, value) || value * unit < 1.0 || value * unit >= 0x1p63) {
        throw_usage("{}: expected bytes such as 1000000, 300K, 512M or 1.5G, got '{}'", option,
                    text);
    }
    return static_cast<uint64_t>(value * unit);
}

std::vector<uint32_t> parse_list(const std::string& text, const std::string& option,
                                 uint32_t lowest, uint32_t highest, uint32_t step) {
    std::vector<uint32_t> values;
    const char* begin = text.data();
    const char* end = begin + text.size();
    while (true) {
        uint32_t value = 0;
        const auto [rest, failure] = std::from_chars(begin, end, value);
        if (failure != std::errc() || (rest != end && *rest != ',') || value < lowest ||
            value > highest || value % step != 0) {
            throw_usage("{}: expected {}numbers from {} to {} separated by commas, got '{}'",
                        option, step == 2 ? "even " : "", lowest, highest, text);
        }
        values.push_back(value);
        if (rest == end) return values;
        begin = rest + 1;
    }
}

Vec3f parse_color(const std::string& text, const std::string& option) {
    std::vector<float> channels;
    std::string_view rest = text;
    while (true) {
        const size_t comma = rest.find(',');
        double value = 0.0;
        if (!parse_number(rest.substr(0, comma), value) || value < 0.0 || value > 1.0) {
            throw_usage("{}: expected R,G,B or one number, each from 0 to 1, got '{}'", option,
                        text);
        }
        channels.push_back(static_cast<float>(value));
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (channels.size() == 1) return Vec3f::Constant(channels[0]);
    if (channels.size() != 3) {
        throw_usage("{}: expected R,G,B or one number, got {} numbers", option, channels.size());
    }
    return {channels[0], channels[1], channels[2]};
}

std::pair<int, int> parse_size(const std::string& text, const std::string& option) {
    constexpr int kMaxSize = 16384;
    const size_t cross = text.find('x');
    double width = 0.0, height = 0.0;
    const auto valid = [](double size) {
        return size >= 1.0 && size <= kMaxSize && size == std::floor(size);
    };
    if (cross == std::string::npos ||
        !parse_number(std::string_view(text).substr(0, cross), width) ||
        !parse_number(std::string_view(text).substr(cross + 1), height) || !valid(width) ||
        !valid(height)) {
        throw_usage("{}: expected WIDTHxHEIGHT in pixels, each 1 to {}, got '{}'", option, kMaxSize,
                    text);
    }
    return {static_cast<int>(width), static_cast<int>(height)};
}

std::string version_text(const std::string& tool) {
    return fmt::format("{} {}", tool, kVersion);
}

}  // namespace paim::cli
