// The error budget as CSV, JSON, chart and section of the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/budget/error_budget.h"
#include "analysis/page.h"
#include "analysis/stage.h"

namespace paim {

// One line for each light and cause, then one for all together.
std::string budget_csv(const ErrorBudget& budget, const std::vector<NamedLight>& lights);

nlohmann::ordered_json budget_json(const ErrorBudget& budget,
                                   const std::vector<NamedLight>& lights);

// A stack of the terms of each light. Errors: those of run_gnuplot().
void write_budget_plot(const std::filesystem::path& output, const ErrorBudget& budget,
                       const std::vector<NamedLight>& lights);

// The error of the file under each light, and its largest cause, as a line.
std::string budget_answer(const std::string& file, const ErrorBudget& budget,
                          const std::vector<NamedLight>& lights);

// file  its name
void add_budget(Page& page, const std::string& file, const ErrorBudget& budget, const Stage& stage);

}  // namespace paim
