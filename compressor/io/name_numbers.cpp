// The numbers in the file names of one folder.
#include "compressor/io/name_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "compressor/io/digit.h"
#include "compressor/io/digit_signs.h"

namespace paim {

namespace {

// The text with '#' for every run of digits.
std::string shape_of(std::string_view text) {
    std::string shape;
    bool in_run = false;
    for (const char c : text) {
        if (!is_digit(c)) {
            shape += c;
        } else if (!in_run) {
            shape += '#';
        }
        in_run = is_digit(c);
    }
    return shape;
}

std::string_view without_hyphen(std::string_view text) {
    if (text.ends_with('-')) text.remove_suffix(1);
    return text;
}

std::string_view without_leading_zeros(std::string_view digits) {
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

// Runs of digits in the stem, each as a number.
std::vector<NameNumber> runs_of(std::string_view name) {
    std::vector<NameNumber> runs;
    const size_t size = stem_size(name);
    for (size_t at = 0; at < size; ++at) {
        if (!is_digit(name[at])) continue;
        const size_t begin = at;
        while (at < size && is_digit(name[at])) ++at;
        runs.push_back(number_of(name, begin, at));
    }
    return runs;
}

// The fractions that stand in the same place of names that are alike.
struct Fractions {
    bool whole_alone = false;  // a name has the whole number without a fraction
    bool plain_zero = false;   // ".0"
    size_t shortest = std::numeric_limits<size_t>::max(), longest = 0;
    size_t longest_after_zero = 0;  // of those that begin with 0
    bool ends_with_zero = false;    // one of two digits or more

    void add(std::string_view digits) {
        shortest = std::min(shortest, digits.size());
        longest = std::max(longest, digits.size());
        if (digits == "0") plain_zero = true;
        if (digits[0] == '0') longest_after_zero = std::max(longest_after_zero, digits.size());
        if (digits.size() >= 2 && digits.back() == '0') ends_with_zero = true;
    }
    bool are_decimal() const {
        if (longest == 0 || (shortest != longest && ends_with_zero)) return false;
        return whole_alone || plain_zero || longest_after_zero > shortest;
    }
};

using Names = std::vector<std::string_view>;
using Numbers = std::vector<std::vector<NameNumber>>;

bool joined_by_point(std::string_view name, const NameNumber& whole, const NameNumber& next) {
    return next.begin == whole.end + 1 && name[whole.end] == '.';
}

std::string place_of_fraction(std::string_view name, const NameNumber& whole, size_t end) {
    return place_of(without_hyphen(name.substr(0, whole.begin)), name.substr(end));
}

// Makes one number of two runs round a decimal point.
void join_fractions(const Names& names, Numbers& numbers) {
    std::unordered_map<std::string, Fractions> places;
    for (size_t i = 0; i < names.size(); ++i) {
        const std::vector<NameNumber>& runs = numbers[i];
        for (size_t k = 0; k + 1 < runs.size(); ++k) {
            if (!joined_by_point(names[i], runs[k], runs[k + 1])) continue;
            const NameNumber& next = runs[k + 1];
            places[place_of_fraction(names[i], runs[k], next.end)].add(
                names[i].substr(next.begin, next.end - next.begin));
        }
    }
    if (places.empty()) return;
    for (size_t i = 0; i < names.size(); ++i) {
        const std::vector<NameNumber>& runs = numbers[i];
        for (size_t k = 0; k < runs.size(); ++k) {
            if (k + 1 < runs.size() && joined_by_point(names[i], runs[k], runs[k + 1])) continue;
            const auto place = places.find(place_of_fraction(names[i], runs[k], runs[k].end));
            if (place != places.end()) place->second.whole_alone = true;
        }
    }
    for (size_t i = 0; i < names.size(); ++i) {
        std::vector<NameNumber>& runs = numbers[i];
        for (size_t k = runs.size(); k-- > 1;) {  // of 1.2.3 the last two come first
            if (!joined_by_point(names[i], runs[k - 1], runs[k])) continue;
            const size_t end = runs[k].end;
            if (!places[place_of_fraction(names[i], runs[k - 1], end)].are_decimal()) continue;
            runs[k - 1] = number_of(names[i], runs[k - 1].begin, end);
            runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(k));
            --k;
            if (k == 0) break;
        }
    }
}

double value_of(const NameNumber& number) {
    const std::string text =
        '0' + std::string(number.whole) + '.' + std::string(number.fraction) + '0';
    double value = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

// The numbers that stand in the same place of names that are alike, with and without a hyphen.
struct Signs {
    struct Kind {
        std::vector<double> values;
        size_t shortest = std::numeric_limits<size_t>::max(), longest = 0;  // with the hyphen
        bool has_zero = false;

        void add(const NameNumber& number, size_t width) {
            values.push_back(value_of(number));
            shortest = std::min(shortest, width);
            longest = std::max(longest, width);
            if (number.is_zero()) has_zero = true;
        }
    } hyphen, plain;
    bool separates_nothing = false;  // the hyphen
    bool padded = false;             // a number of two digits or more begins with 0

    bool are_signs() const {
        if (hyphen.values.empty() || hyphen.has_zero) return false;
        if (separates_nothing) return true;
        if (plain.values.empty()) return false;
        return plain.has_zero || have_one_width() || go_on();
    }

  private:
    bool have_one_width() const {
        return padded && hyphen.shortest == hyphen.longest && plain.shortest == hyphen.longest;
    }
    // Whether the least plain number follows the negative ones in the step of all others.
    bool go_on() const {
        const double gap = *std::min_element(hyphen.values.begin(), hyphen.values.end()) +
                           *std::min_element(plain.values.begin(), plain.values.end());
        double step = std::numeric_limits<double>::infinity();
        for (std::vector<double> values : {hyphen.values, plain.values}) {
            std::sort(values.begin(), values.end());
            for (size_t i = 1; i < values.size(); ++i) {
                if (values[i] > values[i - 1]) step = std::min(step, values[i] - values[i - 1]);
            }
        }
        return std::isfinite(step) && gap <= step * (1.0 + 1e-9);
    }
};

// Where the sign of the number would be, if it has one.
std::optional<size_t> hyphen_before(std::string_view name, const NameNumber& number) {
    if (number.begin == 0 || name[number.begin - 1] != '-') return std::nullopt;
    return number.begin - 1;
}

void find_signs(const Names& names, Numbers& numbers) {
    std::unordered_map<std::string, Signs> places;
    const auto each_hyphen = [&](const auto& use) {
        for (size_t i = 0; i < names.size(); ++i) {
            for (NameNumber& number : numbers[i]) {
                const std::optional<size_t> hyphen = hyphen_before(names[i], number);
                if (!hyphen || (*hyphen > 0 && is_digit(names[i][*hyphen - 1]))) continue;
                use(names[i], number, *hyphen,
                    place_of(names[i].substr(0, *hyphen), names[i].substr(number.end)));
            }
        }
    };
    each_hyphen([&](std::string_view name, const NameNumber& number, size_t hyphen,
                    const std::string& place) {
        Signs& signs = places[place];
        signs.hyphen.add(number, number.end - hyphen);
        signs.separates_nothing = hyphen == 0 || name[hyphen - 1] == '_' || name[hyphen - 1] == '.';
        if (name[number.begin] == '0') signs.padded = true;
    });
    if (places.empty()) return;
    for (size_t i = 0; i < names.size(); ++i) {
        for (const NameNumber& number : numbers[i]) {
            const auto found = places.find(
                place_of(names[i].substr(0, number.begin), names[i].substr(number.end)));
            if (found == places.end()) continue;
            const size_t width = number.end - number.begin;
            found->second.plain.add(number, width);
            if (width > 1 && names[i][number.begin] == '0') found->second.padded = true;
        }
    }
    each_hyphen([&](std::string_view, NameNumber& number, size_t hyphen, const std::string& place) {
        if (!places[place].are_signs()) return;
        number.begin = hyphen;
        number.negative = true;
    });
}

}  // namespace

std::string place_of(std::string_view before, std::string_view after) {
    return shape_of(before) + '\0' + shape_of(after);
}

NameNumber number_of(std::string_view name, size_t begin, size_t end) {
    NameNumber number{begin, end, false, {}, {}};
    const std::string_view text = name.substr(begin, end - begin);
    const size_t point = std::min(text.find('.'), text.size());
    number.whole = without_leading_zeros(text.substr(0, point));
    if (point < text.size()) {
        const std::string_view digits = text.substr(point + 1);
        number.fraction = digits.substr(0, digits.find_last_not_of('0') + 1);
    }
    return number;
}

int compare(const NameNumber& a, const NameNumber& b) {
    if (a.negative != b.negative) return a.negative ? -1 : 1;
    int order = 0;
    if (a.whole.size() != b.whole.size()) {
        order = a.whole.size() < b.whole.size() ? -1 : 1;
    } else {
        order = a.whole.compare(b.whole);
        if (order == 0) order = a.fraction.compare(b.fraction);
    }
    return a.negative ? -order : order;
}

size_t stem_size(std::string_view name) {
    const size_t point = name.rfind('.');
    if (point == std::string_view::npos || point == 0 || point + 1 == name.size()) {
        return name.size();
    }
    return is_digit(name[point + 1]) ? name.size() : point;
}

std::vector<std::vector<NameNumber>> find_numbers(const std::vector<std::string_view>& names) {
    Numbers numbers;
    for (const std::string_view name : names) numbers.push_back(runs_of(name));
    join_fractions(names, numbers);
    find_signs(names, numbers);
    find_signs_behind_digits(names, numbers);
    return numbers;
}

}  // namespace paim
