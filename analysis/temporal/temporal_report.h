// Flicker and held-out poses as CSV, JSON, chart and sections of the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/page.h"
#include "analysis/stage.h"
#include "analysis/temporal/flicker.h"
#include "analysis/temporal/held_out.h"

namespace paim {

// One line for each light and step from a pose to the next.
std::string flicker_csv(const std::vector<Flicker>& flickers,
                        const std::vector<NamedLight>& lights);

nlohmann::ordered_json flicker_json(const std::vector<Flicker>& flickers,
                                    const std::vector<NamedLight>& lights);

// Flicker of each step over time. Errors: those of run_gnuplot().
void write_flicker_plot(const std::filesystem::path& output, const std::vector<Flicker>& flickers,
                        const std::vector<NamedLight>& lights);

// file  its name
void add_flicker(Page& page, const std::string& file, const std::vector<Flicker>& flickers,
                 const std::vector<NamedLight>& lights);

// One line for each light, for the file and for poses that are interpolated as baked.
std::string held_out_csv(const HeldOut& held_out, const std::vector<NamedLight>& lights);

nlohmann::ordered_json held_out_json(const HeldOut& held_out,
                                     const std::vector<NamedLight>& lights);

void add_held_out(Page& page, const HeldOut& held_out, const std::vector<NamedLight>& lights);

}  // namespace paim
