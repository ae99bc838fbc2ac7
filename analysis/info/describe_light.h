// Describes an environment map: its size, mapping and colours, and its spherical-harmonic
// coefficients.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

#include "paim/light/env_mapping.h"

namespace paim {

// A description as JSON. Reads the whole file. Errors: those of load_light().
// bands  1 … sh::kMaxBands
nlohmann::ordered_json describe_light(const std::filesystem::path& path, EnvMapping mapping,
                                      int bands);

// The same as text: lines "key: value", and a table of the coefficients.
std::string light_as_text(const nlohmann::ordered_json& description);

}  // namespace paim
