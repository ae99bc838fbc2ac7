// The prefixes of a .paim that can be played, with their errors.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace paim {

// All prefixes as JSON (docs/format.md). Reads and checks the whole file. Errors: those of the
// reader.
nlohmann::ordered_json describe_prefixes(const std::filesystem::path& path);

// The same as text: a table of about 20 rows.
std::string prefixes_as_text(const nlohmann::ordered_json& description);

}  // namespace paim
