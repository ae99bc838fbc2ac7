// Messages with values in them, in the notation of {fmt}. Only message.cpp includes {fmt}: programs
// that embed Paim, and most of its own files, neither compile nor link it.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

#include "paim/base/export.h"

namespace paim {

// A value in a message. Numbers are printed with the fewest digits that identify them.
using MessageValue = std::variant<bool, char, int64_t, uint64_t, float, double, std::string_view>;

// The text of a message, checked when it is compiled. "{}" stands for the next value, "{:.3g}" (or
// e, f) for the next value that is float or double, and "{{" and "}}" for braces.
template <typename... Values>
class MessageFormat {
  public:
    template <std::convertible_to<std::string_view> Text>
    consteval MessageFormat(const Text& text) : text_(text) {
        size_t num_places = 0;
        for (size_t j = 0; j < text_.size(); ++j) {
            const char brace = text_[j];
            if (brace != '{' && brace != '}') continue;
            if (text_.substr(j + 1, 1) == std::string_view(&brace, 1)) {
                ++j;
                continue;
            }
            const size_t end = text_.find('}', j);
            if (brace == '}' || end == text_.npos) a_brace_stands_alone();
            if (num_places == sizeof...(Values)) more_places_than_values();
            check_place(text_.substr(j + 1, end - j - 1), num_places++);
            j = end;
        }
        if (num_places != sizeof...(Values)) more_values_than_places();
    }

    std::string_view text() const { return text_; }

  private:
    // Not constexpr, so that the compiler rejects a call of one and shows its name.
    static void a_brace_stands_alone() {}
    static void more_places_than_values() {}
    static void more_values_than_places() {}
    static void this_value_has_no_such_format() {}

    static consteval void check_place(std::string_view place, size_t index) {
        constexpr bool kHasPoint[] = {std::is_floating_point_v<Values>..., false};
        if (place.empty()) return;
        const bool good = kHasPoint[index] && place.size() > 1 && place.front() == ':' &&
                          std::string_view("efg").find(place.back()) != place.npos &&
                          place.find_first_not_of(".0123456789", 1) == place.size() - 1;
        if (!good) this_value_has_no_such_format();
    }

    std::string_view text_;
};

namespace detail {

template <typename T>
MessageValue message_value(const T& value) {
    if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, char> ||
                  std::is_floating_point_v<T>) {
        return value;
    } else if constexpr (std::signed_integral<T>) {
        return int64_t{value};
    } else if constexpr (std::unsigned_integral<T>) {
        return uint64_t{value};
    } else {
        return std::string_view(value);
    }
}

}  // namespace detail

PAIM_EXPORT std::string format_message(std::string_view format,
                                       std::initializer_list<MessageValue> values);

// Puts the values into the text.
template <typename... Values>
std::string message(MessageFormat<std::type_identity_t<Values>...> format,
                    const Values&... values) {
    return format_message(format.text(), {detail::message_value(values)...});
}

}  // namespace paim
