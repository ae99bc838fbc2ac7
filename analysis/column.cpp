// A column of a table that is written as CSV and as JSON.
#include "analysis/column.h"

#include <fmt/format.h>

#include "analysis/csv_field.h"

namespace paim {

std::string heading_field(const Column& column) {
    return csv_field(column.unit.empty() ? column.name
                                         : fmt::format("{} [{}]", column.name, column.unit));
}

std::string value_field(const Column& column) {
    const nlohmann::ordered_json& value = column.value;
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_string()) return csv_field(value.get<std::string>());
    if (value.is_number_float()) return fmt::format("{:.9g}", value.get<double>());
    return value.dump();
}

std::string csv_line(const std::vector<Column>& row, std::string (*field_of)(const Column&)) {
    std::string line;
    for (const Column& column : row) {
        line += field_of(column);
        line += &column == &row.back() ? '\n' : ',';
    }
    return line;
}

}  // namespace paim
