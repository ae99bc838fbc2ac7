// The points of a trade as CSV and JSON.
#include "analysis/trade/table.h"

#include <string_view>

#include "analysis/column.h"
#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

namespace {

uint32_t number_of(const TradePoint& point, std::string_view name) {
    for (const CodecNumber& number : point.numbers) {
        if (number.name == name) return number.value;
    }
    return 0;
}

// With the numbers of every codec; 0 where a codec has none of that name.
void add_settings(const TradePoint& point, std::vector<Column>& columns) {
    const TradeSettings& settings = point.settings;
    columns.push_back({"rays", "a vertex; 0: of the given bake", settings.rays});
    columns.push_back({"bands", "", settings.bands});
    columns.push_back({"codec", "", settings.codec});
    columns.push_back({"precision", "", sweep_precision_name(settings.precision)});
    columns.push_back(
        {"preference", "", settings.is_plain() ? "none" : preference_name(settings.preference)});
    columns.push_back({"max_error", "fraction", settings.transfer_error()});
    columns.push_back({"geometry_error", "of the diagonal", settings.geometry_target()});
    columns.push_back({"refined", "", point.refined});
    columns.push_back({"on_front", "", point.on_front});
    columns.push_back({"geometry_components", "", point.geometry_components});
    columns.push_back({"transfer_components", "", point.transfer_components});
    for (const TransferEncoderType& type : transfer_encoders()) {
        for (const char* const name : type.words.numbers) {
            columns.push_back({name, "", number_of(point, name)});
        }
    }
}

void add_cost(const TradePoint& point, std::vector<Column>& columns) {
    columns.push_back({"size", "bytes", point.size_bytes});
    columns.push_back({"rate", "bits per vertex and pose", point.bits_per_vertex_per_pose});
    columns.push_back({"multiply_adds", "per vertex and frame", point.multiply_adds});
    columns.push_back(
        {"position_multiply_adds", "per vertex and frame", point.position_multiply_adds});
    columns.push_back({"cpu_multiply_adds", "per frame", point.cpu_multiply_adds});
}

void add_errors(const TradePoint& point, std::vector<Column>& columns) {
    const AssetError& error = point.error;
    columns.push_back({"visual_error", "fraction", point.visual_error});
    columns.push_back({"transfer_total_error", "fraction", point.transfer_error()});
    columns.push_back({"transfer_deviation", "fraction", error.transfer.error_to_bake});
    columns.push_back({"position_rms", "scene units", error.geometry.rms()});
    columns.push_back({"position_worst", "scene units", error.geometry.worst()});
    columns.push_back({"position_relative_rms", "of the diagonal", error.geometry.relative_rms()});
    columns.push_back({"kg_error", "percent", error.geometry.kg_error()});
    columns.push_back({"sted_worst_piece", "fraction", error.shape.worst.sted()});
    columns.push_back(
        {"normal_angle_deg_worst_piece", "degrees", error.shape.worst.normal_angle_deg});
}

void add_times(const TradePoint& point, std::vector<Column>& columns) {
    columns.push_back({"encode", "s", point.encode_s});
    columns.push_back({"shared", "s", point.shared_s});
    columns.push_back({"frame", "ms", point.frame_ms});
    columns.push_back({"bake", "s", point.bake_s});
}

std::vector<Column> columns_of(const TradePoint& point) {
    std::vector<Column> columns;
    add_settings(point, columns);
    add_cost(point, columns);
    add_errors(point, columns);
    add_times(point, columns);
    return columns;
}

}  // namespace

std::string trade_csv(const std::vector<TradePoint>& points) {
    TradePoint any;
    any.settings.max_error = "1%";
    std::string csv = csv_line(columns_of(any), heading_field);
    for (const TradePoint& point : points) csv += csv_line(columns_of(point), value_field);
    return csv;
}

nlohmann::ordered_json trade_point_json(const TradePoint& point) {
    nlohmann::ordered_json json;
    for (const Column& column : columns_of(point)) json[column.name] = column.value;
    return json;
}

}  // namespace paim
