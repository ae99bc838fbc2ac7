// Natural order of file names.
#include "compressor/io/natural_order.h"

#include <algorithm>

#include "compressor/io/digit.h"

namespace paim {

namespace {

// Removes the digits at the front of the text, and returns them without leading zeros.
std::string_view take_number(std::string_view& text) {
    const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
    std::string_view digits = text.substr(0, static_cast<size_t>(end - text.begin()));
    text.remove_prefix(digits.size());
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
}

// Negative, zero or positive, without the tie-break by bytes.
int compare_naturally(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        if (is_digit(a[0]) && is_digit(b[0])) {
            const std::string_view number_a = take_number(a);
            const std::string_view number_b = take_number(b);
            if (number_a.size() != number_b.size()) {
                return number_a.size() < number_b.size() ? -1 : 1;
            }
            if (const int order = number_a.compare(number_b); order != 0) return order;
        } else {
            const std::string_view byte_a = a.substr(0, 1), byte_b = b.substr(0, 1);
            if (const int order = byte_a.compare(byte_b); order != 0) return order;
            a.remove_prefix(1);
            b.remove_prefix(1);
        }
    }
    return static_cast<int>(!a.empty()) - static_cast<int>(!b.empty());
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
    const int order = compare_naturally(a, b);
    return order != 0 ? order < 0 : a < b;
}

bool natural_path_less(const std::filesystem::path& a, const std::filesystem::path& b) {
    auto part_a = a.begin();
    auto part_b = b.begin();
    for (; part_a != a.end() && part_b != b.end(); ++part_a, ++part_b) {
        const int order = compare_naturally(part_a->native(), part_b->native());
        if (order != 0) return order < 0;
    }
    if ((part_a == a.end()) != (part_b == b.end())) return part_a == a.end();
    return a.native() < b.native();
}

}  // namespace paim
