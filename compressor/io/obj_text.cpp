// Reading OBJ text number by number.
#include "compressor/io/obj_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <system_error>

#include "compressor/io/digit.h"
#include "paim/base/error.h"

namespace paim {

namespace {

// 38 digits stay below the largest float, 3.4e38, so that most numbers need not be evaluated.
constexpr int kSafeDigits = 38;
// Longer words are not numbers, unless all digits belong to a fraction.
constexpr size_t kMaxNumberLength = 128;
// Smaller values are 0 as floats; the smallest positive float is 1.4e-45.
constexpr double kTiny = 1e-60;

enum class Number { finite, zero, too_large, none };

// Classifies a word that is not just a few digits and a point.
Number classify_number(std::string_view word) {
    if (word.size() > kMaxNumberLength) return Number::none;
    const size_t first = word.starts_with('+') || word.starts_with('-') ? 1 : 0;
    // Refuses "+-1", "inf" and "nan", which from_chars() accepts.
    if (first == word.size() || !(is_digit(word[first]) || word[first] == '.')) return Number::none;
    word.remove_prefix(first);
    double size = 0.0;
    const auto [stop, failure] = std::from_chars(word.data(), word.data() + word.size(), size);
    if (failure == std::errc::invalid_argument || stop != word.data() + word.size()) {
        return Number::none;
    }
    if (failure == std::errc::result_out_of_range) {
        // In 128 characters only a negative exponent underflows, and only a positive one overflows.
        const size_t exponent = word.find_first_of("eE");
        return word.substr(exponent + 1).starts_with('-') ? Number::zero : Number::too_large;
    }
    if (size > std::numeric_limits<float>::max()) return Number::too_large;
    return size < kTiny ? Number::zero : Number::finite;
}

}  // namespace

std::string printable(std::string_view text) {
    constexpr size_t kMaxShown = 40;
    std::string shown(text.substr(0, kMaxShown));
    for (char& c : shown) {
        if (c < 0x20 || c > 0x7e) c = '?';
    }
    if (text.size() > kMaxShown) shown += "...";
    return shown;
}

ObjText::ObjText(const std::string& name, std::span<char> text)
    : name_(name), at_(text.data()), end_(text.data() + text.size()) {
    // A byte-order mark would hide the first keyword.
    if (text.size() >= 3 && std::memcmp(at_, "\xEF\xBB\xBF", 3) == 0) std::fill_n(at_, 3, ' ');
}

std::string_view ObjText::read_keyword() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t')) ++at_;
    keyword_ = at_;
    while (!at_line_end() && *at_ != ' ' && *at_ != '\t') ++at_;
    return {keyword_, static_cast<size_t>(at_ - keyword_)};
}

void ObjText::blank_rest_of_line() {
    while (!at_line_end()) *at_++ = ' ';
}

std::string_view ObjText::read_rest_of_line() {
    while (at_ != end_ && (*at_ == ' ' || *at_ == '\t')) ++at_;
    const char* start = at_;
    while (!at_line_end()) ++at_;
    std::string_view rest(start, static_cast<size_t>(at_ - start));
    return rest.substr(0, rest.find_last_not_of(" \t") + 1);
}

void ObjText::next_line() {
    while (!at_line_end()) ++at_;
    if (at_ == end_) return;
    if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    ++at_;
    ++line_;
}

size_t ObjText::continuation_size(const char* at) const {
    if (at == end_ || *at != '\\' || at + 1 == end_) return 0;
    if (at[1] == '\n') return 2;
    if (at[1] != '\r') return 0;
    return at + 2 != end_ && at[2] == '\n' ? 3 : 2;
}

bool ObjText::find_word() {
    while (true) {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\t')) ++at_;
        if (at_line_end()) return false;
        if (*at_ == '#') {
            blank_rest_of_line();
            return false;
        }
        const size_t size_bytes = continuation_size(at_);
        if (size_bytes == 0) return true;
        at_ = std::fill_n(at_, size_bytes, ' ');
        ++line_;
    }
}

bool ObjText::at_word_end() const {
    return at_line_end() || *at_ == ' ' || *at_ == '\t' || continuation_size(at_) > 0;
}

std::string_view ObjText::word_from(const char* start) const {
    const char* stop = start;
    while (stop != end_ && std::strchr(" \t\r\n", *stop) == nullptr) ++stop;
    return {start, static_cast<size_t>(stop - start)};
}

void ObjText::skip_number(const char* what) {
    char* start = at_;
    if (at_ != end_ && *at_ == '-') ++at_;
    const char* integer = at_;
    while (at_ != end_ && is_digit(*at_)) ++at_;
    const auto num_integer_digits = at_ - integer;
    auto num_digits = num_integer_digits;
    if (at_ != end_ && *at_ == '.') {
        ++at_;
        const char* fraction = at_;
        while (at_ != end_ && is_digit(*at_)) ++at_;
        num_digits += at_ - fraction;
    }
    if (num_digits == 0 || num_integer_digits > kSafeDigits || !at_word_end()) {
        skip_unusual_number(start, what);
    }
}

double ObjText::read_number(const char* what) {
    const char* start = at_;
    skip_number(what);
    if (*start == '+') ++start;  // from_chars() accepts no plus sign
    double value = 0.0;
    std::from_chars(start, at_, value);  // leaves 0 if the number is too small for a double
    return value;
}

void ObjText::skip_unusual_number(char* start, const char* what) {
    while (!at_word_end()) ++at_;
    const std::string_view word(start, static_cast<size_t>(at_ - start));
    switch (classify_number(word)) {
        case Number::finite:
            return;
        case Number::zero:
            // Simple parsers overflow while they compute the value of 0e999 or 1e-9999.
            *start = '0';
            std::fill(start + 1, at_, ' ');
            return;
        case Number::too_large:
            fail(fmt::format("{}: expected a number from -3.4e38 to 3.4e38, got '{}'", what,
                             printable(word)));
        case Number::none:
            fail(fmt::format("{}: expected a finite number, got '{}'", what, printable(word)));
    }
}

bool ObjText::read_integer(const char* what, int64_t& value) {
    const auto [stop, failure] = std::from_chars(at_, end_, value);
    if (failure == std::errc::invalid_argument) {
        fail(fmt::format("{}: expected an integer, got '{}'", what, printable(word_from(at_))));
    }
    at_ += stop - at_;
    return failure == std::errc();
}

bool ObjText::skip(char c) {
    if (at_ == end_ || *at_ != c) return false;
    ++at_;
    return true;
}

void ObjText::fail(std::string_view message) const {
    throw_bad_input("{}:{}: {}", name_, line_, message);
}

}  // namespace paim
