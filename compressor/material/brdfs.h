// The BRDFs that options and material libraries can name. brdfs.cpp is the one place that names them.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compressor/material/brdf.h"

namespace paim {

struct BrdfType {
    std::string_view name;                  // "phong"
    std::vector<std::string_view> numbers;  // names of its numbers, in order: "ks", "n"
    std::string_view description;           // for --help
    // Error (usage) names the number that is out of range.
    std::unique_ptr<Brdf> (*make)(std::span<const double> numbers);
};

// The built-in ones, then those that were added.
std::span<const BrdfType> brdf_types();

// Must be called before any other thread uses Paim. No other type has its name (checked).
void add_brdf(BrdfType type);

// text   "NAME:NUMBER,NUMBER…"
// Error (usage): no such name (the message lists the names), another count of numbers, or a number
// that is out of range. The message says which.
std::unique_ptr<Brdf> parse_brdf(std::string_view text);

// The value of one number of a BRDF, for BrdfType::make. Error (usage) names it if it is not between
// least and most.
double brdf_number(std::string_view name, double value, double least, double most);

}  // namespace paim
