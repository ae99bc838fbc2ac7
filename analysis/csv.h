// Error curves as CSV, units in the header.
#pragma once

#include <string>

#include "analysis/curves.h"
#include "analysis/stage.h"

namespace paim {

// One line for each point and light.
std::string curve_csv(const Curve& curve, const std::vector<NamedLight>& lights);

}  // namespace paim
