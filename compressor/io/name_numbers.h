// The numbers in the file names of one folder: which hyphens are signs, which points are decimal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace paim {

// A number in a file name. The views point into the name.
struct NameNumber {
    size_t begin = 0, end = 0;  // in the name, with sign and fraction
    bool negative = false;      // never for zero
    std::string_view whole;     // without leading zeros; empty for 0
    std::string_view fraction;  // without trailing zeros; empty if there is none

    bool is_zero() const { return whole.empty() && fraction.empty(); }
};

// The number of the digits [begin, end), which may have a point among them.
NameNumber number_of(std::string_view name, size_t begin, size_t end);

// What names that are alike have in common: the shape of the text before and after a number.
std::string place_of(std::string_view before, std::string_view after);

// Negative, zero or positive, by value.
int compare(const NameNumber& a, const NameNumber& b);

// The end of the name without its extension (".obj"). A point before a digit begins no extension.
size_t stem_size(std::string_view name);

// The numbers of each name in front of its extension, from left to right.
//
// Every run of the digits 0-9 is a number or its fraction. Names alone do not say whether "t-004"
// is frame -4 or the fourth of a take, nor whether "t.1.25" is frame 1.25 or the 25th of version 1.
// The other names of the folder decide. Below, names are alike if they differ in digits only.
//
// A hyphen before a number is a sign
//   - at the beginning of the name, or after '_' or '.', where it separates nothing;
//   - elsewhere, if an alike name has a number without hyphen in this place (t-004 and t0002), and
//     one such number is 0, or all are padded to one width that counts the sign (-004 and 0002), or
//     they go on where the negative ones end, with the step of the others.
// After a digit it is one by the rules of digit_signs.h alone (walk2-001 and walk20001). It is no sign
// in alike names of which one has it before 0 (walk-00).
//
// A point between two numbers is a decimal point, if
//   - an alike name has the whole number alone (t.1), or the fraction 0 (t.1.0), or a longer
//     fraction that begins with 0 (t.1.05 and t.1.1); and
//   - the fractions have one length, or none of two digits or more ends with 0 (t.1.10 and t.1.9
//     are counted, as versions are).
// Fractions of one length have the same order either way.
// names  must outlive the result
std::vector<std::vector<NameNumber>> find_numbers(const std::vector<std::string_view>& names);

}  // namespace paim
