// Error curves over one setting as charts and sections of the page.
#pragma once

#include <filesystem>

#include "analysis/page.h"
#include "analysis/setting_curves/setting_curve.h"

namespace paim {

// NAME.svg: the errors that are drawn and what is seen, against the setting. Without any error the chart is
// removed if it is there. Errors: those of run_gnuplot().
void write_setting_plot(const std::filesystem::path& directory, const SettingCurve& curve,
                        const std::vector<NamedLight>& lights);

// Chart, table, pictures of all values with their differences from the reference, and a link to NAME.csv.
void add_setting_curve(Page& page, const SettingCurve& curve, const Stage& stage);

}  // namespace paim
