// That tables of an analysis and its JSON hold the same numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "tests/cli/tool_test.h"

namespace paim {

// All numbers of a JSON value.
inline void collect(const nlohmann::json& value, std::vector<double>& numbers) {
    if (value.is_number()) numbers.push_back(value.get<double>());
    if (!value.is_structured()) return;
    for (const nlohmann::json& inner : value) collect(inner, numbers);
}

// A name as both CSV and JSON could have it: "worst_picture_pose" and "worst_pose" differ, units do not
// count.
inline std::string plain_name(const std::string& heading) {
    return heading.substr(0, heading.find(" ["));
}

// Numbers of a JSON object by name, those of inner objects with them.
inline void collect_by_name(const nlohmann::json& object, std::map<std::string, double>& numbers) {
    for (const auto& [name, value] : object.items()) {
        if (value.is_number()) numbers[name] = value.get<double>();
        if (value.is_object()) collect_by_name(value, numbers);
    }
}

// Numbers of a row that the JSON has under the same name are the same, to the digits of the row.
// returns  how many there are
inline int expect_same_names(const Arguments& heading, const Arguments& row,
                             const nlohmann::json& object) {
    std::map<std::string, double> numbers;
    collect_by_name(object, numbers);
    int count = 0;
    for (size_t n = 0; n < heading.size(); ++n) {
        const auto found = numbers.find(plain_name(heading[n]));
        if (found == numbers.end()) continue;
        EXPECT_NEAR(std::stod(row[n]), found->second, 5e-3 * std::abs(found->second)) << heading[n];
        ++count;
    }
    return count;
}

// Every number of the table is somewhere in the JSON, to the digits of the table.
inline void expect_numbers_are_in(const std::vector<Arguments>& lines, const nlohmann::json& all) {
    std::vector<double> numbers;
    collect(all, numbers);
    ASSERT_GE(lines.size(), 2u);
    for (size_t j = 1; j < lines.size(); ++j) {
        ASSERT_EQ(lines[j].size(), lines[0].size()) << j;
        for (size_t n = 0; n < lines[j].size(); ++n) {
            char* end = nullptr;
            const double value = std::strtod(lines[j][n].c_str(), &end);
            if (*end != '\0' || !std::isfinite(value)) continue;  // a name, or null in JSON
            EXPECT_TRUE(std::any_of(
                numbers.begin(), numbers.end(),
                [&](double number) { return std::abs(number - value) <= 5e-3 * std::abs(value); }))
                << lines[0][n] << ": " << lines[j][n];
        }
    }
}

}  // namespace paim
