// Describes an environment map.
#include "analysis/info/describe_light.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/info/describe.h"
#include "paim/light/load_light.h"
#include "paim/sh/index.h"

namespace paim {

using nlohmann::ordered_json;

namespace {

constexpr const char* kNormalisation =
    "real, orthonormal, no Condon-Shortley phase, polar axis z; i = l (l + 1) + m";

ordered_json colours_of(const LoadedLight& loaded) {
    const auto& stated = loaded.header.chromaticities;
    if (!stated) return nullptr;
    ordered_json json;
    const auto put = [&](const char* name, const Eigen::Vector2d& xy) {
        json[name] = {xy.x(), xy.y()};
    };
    put("red", stated->red);
    put("green", stated->green);
    put("blue", stated->blue);
    put("white", stated->white);
    return json;
}

ordered_json rgb(const Vec3f& value) {
    return {value.x(), value.y(), value.z()};
}

}  // namespace

ordered_json describe_light(const std::filesystem::path& path, EnvMapping mapping, int bands) {
    const LoadedLight loaded = load_light(path, mapping);
    const LightCoefficients light = loaded.light.coefficients(bands);
    ordered_json json;
    json["file"] = path.string();
    json["kind"] = "light";
    json["size_bytes"] = std::filesystem::file_size(path);
    json["width"] = loaded.header.width;
    json["height"] = loaded.header.height;
    json["mapping"] = env_mapping_name(loaded.mapping.mapping);
    json["mapping_by"] = loaded.mapping.reason;
    json["chromaticities"] = colours_of(loaded);
    json["converted_to_rec709"] = loaded.converted_colours;
    if (loaded.header.white_luminance) json["white_luminance"] = *loaded.header.white_luminance;
    json["notes"] = loaded.notes;
    json["mean_radiance"] = rgb(light.values[0] / static_cast<float>(std::sqrt(4.0 * kPi)));
    json["bands"] = bands;
    json["normalisation"] = kNormalisation;
    json["coefficients"] = ordered_json::array();
    for (int l = 0; l < bands; ++l) {
        for (int m = -l; m <= l; ++m) {
            const Vec3f& value = light.values[static_cast<size_t>(sh::index(l, m))];
            json["coefficients"].push_back({{"l", l}, {"m", m}, {"rgb", rgb(value)}});
        }
    }
    return json;
}

std::string light_as_text(const ordered_json& description) {
    ordered_json head = description;
    head.erase("coefficients");
    head.erase("notes");
    if (head["chromaticities"].is_null()) head["chromaticities"] = "not stated, Rec. 709";
    std::string text = as_text(head);
    for (const auto& note : description["notes"]) {
        text += fmt::format("note: {}\n", note.get<std::string>());
    }
    text += fmt::format("{:>3}{:>4}{:>15}{:>15}{:>15}\n", "l", "m", "red", "green", "blue");
    for (const auto& entry : description["coefficients"]) {
        text += fmt::format("{:>3}{:>4}", entry["l"].get<int>(), entry["m"].get<int>());
        for (const auto& value : entry["rgb"]) {
            text += fmt::format("{:>15.7g}", value.get<float>());
        }
        text += '\n';
    }
    return text;
}

}  // namespace paim
