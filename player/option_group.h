// Options of one group of --help, and checks of their values.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "paim/base/error.h"
#include "paim/cli/parse.h"

namespace paim::player {

// Adds options to one group of --help. Each is described in one place, so that --help is their
// documentation.
class OptionGroup {
  public:
    OptionGroup(CLI::App& app, std::string name) : app_(app), name_(std::move(name)) {}

    template <typename Value>
    void add(const char* name, Value& value, const char* unit, const char* text) {
        app_.add_option(name, value, text)->type_name(unit)->group(name_);
    }
    void add_flag(const char* name, bool& value, const char* text) {
        app_.add_flag(name, value, text)->group(name_);
    }
    template <typename Value, typename Choices>
    void add_choice(const char* name, Value& value, const Choices& choices, const char* text) {
        cli::add_choice(app_, name, value, choices, text)->group(name_);
    }

  private:
    CLI::App& app_;
    std::string name_;
};

inline void require_range(const char* option, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return;  // false for NaN
    throw_usage("{}: expected a number from {} to {}, got {}", option, lowest, highest, value);
}

// "1,2.5,3" as `least` to `most` numbers. Error (usage), which says what was expected, if it is
// anything else.
std::vector<double> parse_numbers(const char* option, const std::string& text, size_t least,
                                  size_t most, const char* expected);

inline std::optional<int> integer_in_range(const char* option, std::optional<double> value,
                                           int lowest, int highest) {
    if (!value) return std::nullopt;
    if (*value >= lowest && *value <= highest && *value == std::floor(*value)) {
        return static_cast<int>(*value);
    }
    throw_usage("{}: expected a whole number from {} to {}, got {}", option, lowest, highest,
                *value);
}

}  // namespace paim::player
