// Error curves over one setting whose every value is measured by itself: components of a vertex, groups of
// vertices, rays.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/column.h"
#include "analysis/picture_errors.h"
#include "analysis/reference/reference_pictures.h"
#include "analysis/stage.h"

namespace paim {

// One value of the setting, and what was measured of it.
struct Setting {
    uint32_t value = 0;
    bool all = false;                 // the most that there are
    std::vector<Column> columns;      // numbers; the same names and units at each value of a curve
    std::vector<PictureErrors> seen;  // [lights] against the reference
    std::vector<Image> images;        // [lights] of the first measured pose in the first view

    // The number of this name; not a number if there is none.
    double number(const std::string& name) const;
};

struct SettingCurve {
    std::string name;                // of the files of the curve, and of its column
    std::string title;               // for reports
    std::string explanation;         // what was done, in sentences
    std::string axis;                // the setting in words: "rays a vertex"
    bool logarithmic = false;        // the axis of the chart
    std::vector<Setting> settings;   // descending
    std::vector<std::string> drawn;  // the columns that are errors, besides what is seen
    std::string reference_name;      // what pictures are compared with
    std::vector<Image> reference;    // [lights] of the first measured pose in the first view
    std::vector<double> noise;       // [lights] of the reference, relative
};

// Adds the pictures of one pose to a setting: compared with those of the reference, and kept if it is
// the first pose.
// pictures, expected  [Stage::num_pictures()]
void add_pictures(Setting& setting, const Stage& stage, uint32_t p, std::vector<Image> pictures,
                  const std::vector<Image>& expected);

// Those of `wanted` that there are, and the most, descending and each once.
std::vector<uint32_t> values_up_to(uint32_t most, const std::vector<uint32_t>& wanted);

// A line for each light and value, units in the heading.
std::string setting_curve_csv(const SettingCurve& curve, const std::vector<NamedLight>& lights);

// The same numbers by the same names: those of a light below "lights".
nlohmann::ordered_json setting_curve_json(const SettingCurve& curve,
                                          const std::vector<NamedLight>& lights);

}  // namespace paim
