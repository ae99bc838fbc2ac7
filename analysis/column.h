// A column of a table that is written as CSV and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace paim {

// Of text or of numbers: the name, the unit, and the value of one row.
struct Column {
    std::string name, unit;  // without a unit: empty
    nlohmann::ordered_json value;
};

// "name [unit]" as a field of CSV.
std::string heading_field(const Column& column);

// The value as a field of CSV: "yes" and "no", nine digits of what is no whole number.
std::string value_field(const Column& column);

// A line of CSV: such a field of each column.
std::string csv_line(const std::vector<Column>& row, std::string (*field_of)(const Column&));

}  // namespace paim
