// What a .paim file or a .bake directory holds.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace paim {

// Everything about the file as JSON. Reads and checks all of it. Errors: those of the readers.
nlohmann::ordered_json describe(const std::filesystem::path& path);

// The same for people, as indented lines "key: value".
std::string as_text(const nlohmann::ordered_json& description);

}  // namespace paim
