// The BRDFs that options and material libraries can name.
#include "compressor/material/brdfs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "compressor/material/cook_torrance.h"
#include "compressor/material/phong.h"
#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim {

namespace {

std::vector<BrdfType>& types() {
    static std::vector<BrdfType> all{phong(), cook_torrance()};
    return all;
}

const BrdfType& type_of(std::string_view name, std::string_view text) {
    std::vector<std::string_view> names;
    for (const BrdfType& type : types()) {
        if (type.name == name) return type;
        names.push_back(type.name);
    }
    throw_usage("BRDF \"{}\": there is no \"{}\", but {}", text, name,
                fmt::format("{}", fmt::join(names, ", ")));
}

double parse_number(std::string_view word, std::string_view text) {
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc() || stop != end) {
        throw_usage("BRDF \"{}\": \"{}\" is not a number", text, word);
    }
    return value;
}

}  // namespace

std::span<const BrdfType> brdf_types() {
    return types();
}

void add_brdf(BrdfType type) {
    for (const BrdfType& other : types()) PAIM_CHECK(type.name != other.name);
    types().push_back(std::move(type));
}

std::unique_ptr<Brdf> parse_brdf(std::string_view text) {
    const size_t colon = text.find(':');
    const BrdfType& type = type_of(text.substr(0, colon), text);
    std::vector<double> numbers;
    std::string_view rest = colon == text.npos ? std::string_view() : text.substr(colon + 1);
    while (!rest.empty() && numbers.size() <= type.numbers.size()) {
        const size_t comma = rest.find(',');
        numbers.push_back(parse_number(rest.substr(0, comma), text));
        if (comma == rest.npos) break;
        rest.remove_prefix(comma + 1);
        if (rest.empty()) throw_usage("BRDF \"{}\": a number is missing at the end", text);
    }
    if (numbers.size() != type.numbers.size()) {
        throw_usage("BRDF \"{}\": expected {}:{}", text, type.name,
                    fmt::format("{}", fmt::join(type.numbers, ",")));
    }
    return type.make(numbers);
}

double brdf_number(std::string_view name, double value, double least, double most) {
    if (!(least <= value && value <= most)) {
        throw_usage("BRDF: {} is {}, expected {} to {}", name, value, least, most);
    }
    return value + 0.0;  // −0 becomes 0
}

}  // namespace paim
