// JSON as text.
#pragma once

#include <string>

namespace paim {

// Of a value of nlohmann::json or ordered_json, on one line or indented. Names of files may be any
// bytes: those that are not UTF-8 become U+FFFD, where dump() alone throws.
template <typename Json>
std::string json_text(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace paim
