// Checked access to the JSON that Paim files carry.
#include "paim/format/metadata.h"

#include <utility>

#include "paim/base/error.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

constexpr size_t kMaxSizeBytes = 64 << 20;

// The value as text, short enough for a message.
std::string shown(const ordered_json& value) {
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace).substr(0, 60);
}

}  // namespace

Metadata::Metadata(std::string_view text, std::string file) : file_(std::move(file)) {
    if (text.size() > kMaxSizeBytes) {
        throw_bad_input("{}: {} bytes of metadata, expected at most {}", file_, text.size(),
                        kMaxSizeBytes);
    }
    json_ = ordered_json::parse(text, nullptr, false);
    if (!json_.is_object()) throw_bad_input("{}: the metadata is not a JSON object", file_);
}

const ordered_json& Metadata::member(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) throw_bad_input("{}: metadata: '{}' is missing", file_, key);
    return *found;
}

uint32_t Metadata::integer(const char* key, uint32_t lowest, uint32_t highest) const {
    const ordered_json& value = member(key);
    if (!value.is_number_unsigned() || value.get<uint64_t>() < lowest ||
        value.get<uint64_t>() > highest) {
        throw_bad_input("{}: metadata: '{}': expected {} to {}, got {}", file_, key, lowest,
                        highest, shown(value));
    }
    return value.get<uint32_t>();
}

double Metadata::number(const char* key, double lowest, double highest) const {
    const ordered_json& value = member(key);
    if (!value.is_number() || !(value.get<double>() >= lowest && value.get<double>() <= highest)) {
        throw_bad_input("{}: metadata: '{}': expected {} to {}, got {}", file_, key, lowest,
                        highest, shown(value));
    }
    return value.get<double>();
}

std::string Metadata::text(const char* key) const {
    const ordered_json& value = member(key);
    if (!value.is_string()) {
        throw_bad_input("{}: metadata: '{}': expected text, got {}", file_, key, shown(value));
    }
    return value.get<std::string>();
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
