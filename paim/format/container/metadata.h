// Checked access to the JSON metadata of Paim files.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

// A JSON object whose members are read with their type and range checked. Errors (bad input) name
// the file, the member, what was expected and what was got.
class Metadata {
  public:
    // Parses the text: an object of at most 64 MiB, nested at most 16 deep.
    Metadata(std::string_view text, std::string file);

    // An object within a parsed one.
    static Metadata part(const nlohmann::json& part, const std::string& file);

    uint32_t integer(const char* key, uint32_t lowest, uint32_t highest) const;
    double number(const char* key, double lowest, double highest) const;
    std::vector<double> numbers(const char* key, size_t count, double lowest, double highest) const;
    std::string text(const char* key) const;
    uint32_t count(const char* key) const;  // up to 2^32 - 1; 0 if absent
    Vec3d point(const char* key) const;     // of three numbers up to ±4e38; zero if absent
    std::string object_text(const char* key) const;  // "{}" if absent
    const nlohmann::json& root() const { return json_; }
    const std::string& file() const { return file_; }

  private:
    Metadata() = default;
    const nlohmann::json& member(const char* key) const;

    nlohmann::json json_;
    std::string file_;
};

}  // namespace paim
