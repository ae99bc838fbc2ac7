// The table of view_fields.h, written and read.
#include "player/view/view_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/json_text.h"
#include "player/view/view_fields.h"

namespace paim::player {

namespace {

using nlohmann::ordered_json;

constexpr uint64_t kMaxFileBytes = 1'000'000;

// The path of a field in the JSON object: "light.yaw_deg" is /light/yaw_deg.
ordered_json::json_pointer pointer_of(std::string name) {
    std::replace(name.begin(), name.end(), '.', '/');
    return ordered_json::json_pointer("/" + name);
}

template <typename Value>
const std::string& word_of(const Value& value, const Names<Value>& names) {
    return std::find_if(names.begin(), names.end(),
                        [&](const auto& n) { return n.second == value; })
        ->first;
}

struct Writer {
    ordered_json json = ordered_json::object();

    template <typename Number>
    void number(const char* name, const Number& value, double, double) {
        json[pointer_of(name)] = value;
    }
    void count(const char* name, uint32_t value, uint32_t, uint32_t) {
        json[pointer_of(name)] = value;
    }
    void flag(const char* name, bool value) { json[pointer_of(name)] = value; }
    template <typename Vector>
    void vector(const char* name, const Vector& value, double, double) {
        json[pointer_of(name)] = {value[0], value[1], value[2]};
    }
    template <typename Value>
    void word(const char* name, const Value& value, const Names<Value>& names) {
        json[pointer_of(name)] = word_of(value, names);
    }
};

class Reader {
  public:
    Reader(const ordered_json& json, std::string file) : json_(json), file_(std::move(file)) {}

    template <typename Number>
    void number(const char* name, Number& value, double lowest, double highest) {
        const ordered_json* const found = find(name);
        if (found == nullptr) return;
        value = static_cast<Number>(number_in(*found, name, lowest, highest));
    }
    void count(const char* name, uint32_t& value, uint32_t lowest, uint32_t highest) {
        const ordered_json* const found = find(name);
        if (found == nullptr) return;
        const bool is_count = found->is_number_unsigned();
        if (!is_count || found->get<uint64_t>() < lowest || found->get<uint64_t>() > highest) {
            refuse(name, fmt::format("a whole number from {} to {}", lowest, highest), *found);
        }
        value = found->get<uint32_t>();
    }
    void flag(const char* name, bool& value) {
        const ordered_json* const found = find(name);
        if (found == nullptr) return;
        if (!found->is_boolean()) refuse(name, "true or false", *found);
        value = found->get<bool>();
    }
    template <typename Vector>
    void vector(const char* name, Vector& value, double lowest, double highest) {
        const ordered_json* const found = find(name);
        if (found == nullptr) return;
        if (!found->is_array() || found->size() != 3) refuse(name, "three numbers", *found);
        for (int axis = 0; axis < 3; ++axis) {
            const ordered_json& item = (*found)[static_cast<size_t>(axis)];
            value[axis] =
                static_cast<typename Vector::Scalar>(number_in(item, name, lowest, highest));
        }
    }
    template <typename Value>
    void word(const char* name, Value& value, const Names<Value>& names) {
        const ordered_json* const found = find(name);
        if (found == nullptr) return;
        std::string expected;
        for (const auto& [word, choice] : names) {
            if (*found == word) {
                value = choice;
                return;
            }
            expected += (expected.empty() ? "'" : ", '") + word + "'";
        }
        refuse(name, expected, *found);
    }

    bool has(const char* name) const { return json_.contains(pointer_of(name)); }

    // Error where the file has a field that is none.
    void refuse_others() const {
        for (const auto& [group, fields] : json_.items()) {
            if (!fields.is_object() || !groups_.contains(group)) {
                // Not "light.yaw_deg": that is {"light": {"yaw_deg": …}}.
                refuse_unless(known_.contains(group) && group.find('.') == std::string::npos,
                              group);
                continue;
            }
            for (const auto& [field, value] : fields.items()) {
                const std::string name = group + "." + field;
                refuse_unless(known_.contains(name), name);
            }
        }
    }

  private:
    const ordered_json* find(const char* name) {
        const std::string path = name;
        known_.insert(path);
        groups_.insert(path.substr(0, path.find('.')));
        return has(name) ? &json_.at(pointer_of(path)) : nullptr;
    }
    void refuse_unless(bool known, const std::string& name) const {
        if (!known) throw_bad_input("{}: unknown field '{}'", file_, name);
    }
    double number_in(const ordered_json& json, const char* name, double lowest,
                     double highest) const {
        const double value = json.is_number() ? json.get<double>() : std::nan("");
        if (value >= lowest && value <= highest) return value;
        throw_bad_input("{}: {}: expected a number from {} to {}, got {}", file_, name, lowest,
                        highest, shortened(json));
    }
    [[noreturn]] void refuse(const char* name, const std::string& expected,
                             const ordered_json& json) const {
        throw_bad_input("{}: {}: expected {}, got {}", file_, name, expected, shortened(json));
    }
    static std::string shortened(const ordered_json& json) {
        constexpr size_t kMost = 60;
        std::string text = json_text(json);
        if (text.size() <= kMost) return text;
        size_t end = kMost;
        while ((text[end] & 0xc0) == 0x80) --end;  // UTF-8: whole characters
        return text.substr(0, end) + "…";
    }

    const ordered_json& json_;
    std::string file_;
    std::set<std::string> known_, groups_;  // names of fields, and their first parts
};

ordered_json parse(const std::filesystem::path& path) {
    constexpr int kMaxDepth = 8;
    const std::vector<char> text = read_file(path, kMaxFileBytes);
    bool deep = false;
    const auto check = [&](int depth, ordered_json::parse_event_t, ordered_json&) {
        deep = deep || depth > kMaxDepth;
        return !deep;
    };
    ordered_json json = ordered_json::parse(text.begin(), text.end(), check, false);
    if (deep || !json.is_object()) {
        throw_bad_input("{}: expected a view file (a JSON object of fields)", path.string());
    }
    return json;
}

ViewState in_scene(const ViewState& view, const SceneUnits& units) {
    ViewState scene = view;
    OrbitCamera& orbit = scene.camera.orbit;
    // Where the camera follows the body, the place is relative to it.
    const bool relative = view.camera.target == CameraTarget::pose;
    orbit.target = relative ? Vec3d(orbit.target / units.scale) : units.to_scene(orbit.target);
    orbit.distance /= units.scale;
    return scene;
}

void to_model(ViewState& view, const SceneUnits& units) {
    OrbitCamera& orbit = view.camera.orbit;
    const bool relative = view.camera.target == CameraTarget::pose;
    orbit.target = relative ? Vec3d(orbit.target * units.scale) : units.to_model(orbit.target);
    orbit.distance *= units.scale;
    orbit.framed_distance = orbit.distance;
}

}  // namespace

void write_view(const std::filesystem::path& path, const ViewState& view, const SceneUnits& units) {
    Writer writer;
    const ViewState scene = in_scene(view, units);
    visit_fields(scene, writer);
    write_file(path, json_text(writer.json, 2) + "\n");
}

void read_view(const std::filesystem::path& path, const SceneUnits& units, ViewState& view) {
    const ordered_json json = parse(path);
    ViewState scene = in_scene(view, units);
    Reader reader(json, path.string());
    visit_fields(scene, reader);
    reader.refuse_others();
    if (scene.tone_curve.gamma != 0.0f && scene.tone_curve.gamma < kLowestGamma) {
        throw_bad_input("{}: display.gamma: expected 0 or a number from {} to {}, got {}",
                        path.string(), kLowestGamma, kHighestGamma, scene.tone_curve.gamma);
    }
    to_model(scene, units);
    // Not converted there and back: what the camera looks at may have become another kind of place.
    const OrbitCamera& before = view.camera.orbit;
    OrbitCamera& orbit = scene.camera.orbit;
    if (!reader.has("camera.place")) orbit.target = before.target;
    if (!reader.has("camera.distance")) {
        orbit.distance = before.distance;
        orbit.framed_distance = before.framed_distance;
    }
    view = scene;
}

}  // namespace paim::player
