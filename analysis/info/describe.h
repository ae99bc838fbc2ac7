// Describes a .paim file or a .bake directory.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace paim {

// A description of the file as JSON. Reads and checks the whole file. Errors: those of the readers.
nlohmann::ordered_json describe(const std::filesystem::path& path);

// The same as text: indented lines "key: value".
std::string as_text(const nlohmann::ordered_json& description);

}  // namespace paim
