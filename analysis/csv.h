// Tables as CSV (RFC 4180), units in the header.
#pragma once

#include <string>
#include <vector>

#include "analysis/curves.h"
#include "analysis/stage.h"

namespace paim {

// One line for each point and light.
// reference_noise  [lights] of the pictures that were compared with, relative
std::string curve_csv(const Curve& curve, const std::vector<NamedLight>& lights,
                      const std::vector<double>& reference_noise);

}  // namespace paim
