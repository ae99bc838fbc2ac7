// Error curves over one setting as tables.
#include "analysis/setting_curves/setting_curve.h"

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "analysis/csv_field.h"
#include "paim/metrics/image_error.h"

namespace paim {

namespace {

// What is seen under one light.
std::vector<Column> seen_columns(const PictureErrors& seen, double reference_noise) {
    const PictureErrors::Spread spread = seen.spread();
    return {{"visual_error", "fraction", seen.visual_error()},
            {"visual_error_least", "fraction", spread.least},
            {"visual_error_median", "fraction", spread.median},
            {"visual_error_most", "fraction", spread.most},
            {"visual_error_deviation", "fraction", spread.deviation},
            {"worst_picture_pose", "", spread.worst_pose},
            {"worst_picture_view", "", spread.worst_view},
            {"reference_noise", "fraction", reference_noise}};
}

// Of the setting, then of the light.
std::vector<Column> row_of(const SettingCurve& curve, const Setting& setting,
                           const std::vector<NamedLight>& lights, size_t light) {
    std::vector<Column> row{{"light", "", lights[light].name},
                            {curve.name, "", setting.value},
                            {"all", "", setting.all}};
    row.insert(row.end(), setting.columns.begin(), setting.columns.end());
    const std::vector<Column> seen = seen_columns(setting.seen[light], curve.noise[light]);
    row.insert(row.end(), seen.begin(), seen.end());
    return row;
}

}  // namespace

double Setting::number(const std::string& name) const {
    for (const Column& column : columns) {
        if (column.name == name) return column.value.get<double>();
    }
    return std::numeric_limits<double>::quiet_NaN();
}

void add_pictures(Setting& setting, const Stage& stage, uint32_t p, std::vector<Image> pictures,
                  const std::vector<Image>& expected) {
    const size_t num_lights = stage.lights().size();
    setting.seen.resize(num_lights);
    for (size_t k = 0; k < pictures.size(); ++k) {
        setting.seen[k % num_lights].add(compare_images(pictures[k], expected[k]), p,
                                         k / num_lights);
    }
    if (p != stage.poses().front()) return;
    pictures.resize(num_lights);
    setting.images = std::move(pictures);
}

std::vector<uint32_t> values_up_to(uint32_t most, const std::vector<uint32_t>& wanted) {
    std::set<uint32_t, std::greater<>> values{most};
    for (const uint32_t value : wanted) {
        if (value < most) values.insert(value);
    }
    return {values.begin(), values.end()};
}

std::string setting_curve_csv(const SettingCurve& curve, const std::vector<NamedLight>& lights) {
    std::string csv = csv_line(row_of(curve, curve.settings.front(), lights, 0), heading_field);
    for (size_t light = 0; light < lights.size(); ++light) {
        for (const Setting& setting : curve.settings) {
            csv += csv_line(row_of(curve, setting, lights, light), value_field);
        }
    }
    return csv;
}

nlohmann::ordered_json setting_curve_json(const SettingCurve& curve,
                                          const std::vector<NamedLight>& lights) {
    auto settings = nlohmann::ordered_json::array();
    for (const Setting& setting : curve.settings) {
        nlohmann::ordered_json json{{curve.name, setting.value}, {"all", setting.all}};
        for (const Column& column : setting.columns) json[column.name] = column.value;
        for (size_t light = 0; light < lights.size(); ++light) {
            nlohmann::ordered_json& of_light = json["lights"][lights[light].name];
            for (const Column& column : seen_columns(setting.seen[light], curve.noise[light])) {
                of_light[column.name] = column.value;
            }
        }
        settings.push_back(std::move(json));
    }
    return settings;
}

}  // namespace paim
