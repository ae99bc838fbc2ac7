// Checked access to the JSON metadata of Paim files.
#include "paim/format/container/metadata.h"

#include <cmath>
#include <limits>
#include <utility>

#include "paim/base/error.h"
#include "paim/base/json_text.h"

namespace paim {

using nlohmann::json;

namespace {

constexpr size_t kMaxSizeBytes = 64 << 20;
constexpr int kMaxDepth = 16;

// The value as text, short enough for a message.
std::string shown(const json& value) {
    return json_text(value).substr(0, 60);
}

}  // namespace

Metadata::Metadata(std::string_view text, std::string file) : file_(std::move(file)) {
    if (text.size() > kMaxSizeBytes) {
        throw_bad_input("{}: {} bytes of metadata, expected at most {}", file_, text.size(),
                        kMaxSizeBytes);
    }
    // Parsing is iterative, but writing and copying the result are recursive, so depth is limited.
    bool too_deep = false;
    const auto check_depth = [&](int depth, json::parse_event_t, json&) {
        too_deep = too_deep || depth > kMaxDepth;
        return !too_deep;
    };
    json_ = json::parse(text, check_depth, false);
    if (too_deep) {
        throw_bad_input("{}: the metadata is nested more than {} deep", file_, kMaxDepth);
    }
    if (!json_.is_object()) throw_bad_input("{}: the metadata is not a JSON object", file_);
}

Metadata Metadata::part(const json& part, const std::string& file) {
    if (!part.is_object()) throw_bad_input("{}: the metadata is not a JSON object", file);
    Metadata metadata;
    metadata.json_ = part;
    metadata.file_ = file;
    return metadata;
}

const json& Metadata::member(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) throw_bad_input("{}: metadata: '{}' is missing", file_, key);
    return *found;
}

uint32_t Metadata::integer(const char* key, uint32_t lowest, uint32_t highest) const {
    const json& value = member(key);
    if (!value.is_number_unsigned() || value.get<uint64_t>() < lowest ||
        value.get<uint64_t>() > highest) {
        throw_bad_input("{}: metadata: '{}': expected {} to {}, got {}", file_, key, lowest,
                        highest, shown(value));
    }
    return value.get<uint32_t>();
}

double Metadata::number(const char* key, double lowest, double highest) const {
    const json& value = member(key);
    if (!value.is_number() || !(value.get<double>() >= lowest && value.get<double>() <= highest)) {
        throw_bad_input("{}: metadata: '{}': expected {} to {}, got {}", file_, key, lowest,
                        highest, shown(value));
    }
    return value.get<double>();
}

std::vector<double> Metadata::numbers(const char* key, size_t count, double lowest,
                                      double highest) const {
    const json& value = member(key);
    if (!value.is_array() || value.size() != count) {
        throw_bad_input("{}: metadata: '{}': expected {} numbers, got {}", file_, key, count,
                        shown(value));
    }
    std::vector<double> numbers;
    for (const json& entry : value) {
        const double number = entry.is_number() ? entry.get<double>() : std::nan("");
        if (!(number >= lowest && number <= highest)) {
            throw_bad_input("{}: metadata: '{}': expected {} to {}, got {}", file_, key, lowest,
                            highest, shown(entry));
        }
        numbers.push_back(number);
    }
    return numbers;
}

std::string Metadata::text(const char* key) const {
    const json& value = member(key);
    if (!value.is_string()) {
        throw_bad_input("{}: metadata: '{}': expected text, got {}", file_, key, shown(value));
    }
    return value.get<std::string>();
}

uint32_t Metadata::count(const char* key) const {
    return json_.contains(key) ? integer(key, 0, std::numeric_limits<uint32_t>::max()) : 0;
}

Vec3d Metadata::point(const char* key) const {
    Vec3d result = Vec3d::Zero();
    const auto found = json_.find(key);
    if (found == json_.end()) return result;
    // The range of float, and half a step of an origin (mesh/origin.h) at the end of that range.
    constexpr double kMax = 4e38;
    bool good = found->is_array() && found->size() == 3;
    for (size_t i = 0; good && i < 3; ++i) {
        const json& value = (*found)[i];
        good = value.is_number() && std::abs(value.get<double>()) <= kMax;
        if (good) result[static_cast<Eigen::Index>(i)] = value.get<double>();
    }
    if (!good) {
        throw_bad_input("{}: metadata: '{}': expected three numbers, got {}", file_, key,
                        shown(*found));
    }
    return result;
}

std::string Metadata::object_text(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) return "{}";
    if (!found->is_object()) {
        throw_bad_input("{}: metadata: '{}': expected an object, got {}", file_, key,
                        shown(*found));
    }
    return found->dump();
}

}  // namespace paim
