// How the pixels of an environment map lie on the sphere.
// Based on: OpenEXR, ImfEnvmap.h (the attribute `envmap`)
#include "paim/light/env_mapping.h"

#include <fmt/format.h>

#include "paim/base/error.h"

namespace paim {

namespace {

constexpr int kEnvmapLatlong = 0;
constexpr int kEnvmapCube = 1;

std::string size_text(const ExrHeader& header) {
    return fmt::format("{} x {} pixels", header.width, header.height);
}

bool has_shape_of_cube(const ExrHeader& header) {
    return header.height == 6 * header.width;
}

// By the attribute alone, or automatic.
MappingChoice by_attribute(const ExrHeader& header) {
    const char* const reason = "attribute envmap";
    if (!header.envmap) return {EnvMapping::automatic, ""};
    if (*header.envmap == kEnvmapLatlong) return {EnvMapping::latlong, reason};
    if (*header.envmap == kEnvmapCube) return {EnvMapping::cube, reason};
    return {EnvMapping::automatic,
            "",
            {fmt::format("its attribute envmap is {}, expected 0 (lat-long) or 1 (cube); ignored",
                         *header.envmap)}};
}

MappingChoice by_shape(const ExrHeader& header, const std::function<bool()>& black_outside) {
    if (header.width == 2 * header.height) return {EnvMapping::latlong, "size"};
    const std::string size = size_text(header);
    if (has_shape_of_cube(header)) {
        return {EnvMapping::cube,
                "size",
                {size + ", expected 2:1 of a lat-long map; read as a cube map, which is 1:6 "
                        "(--env-mapping latlong reads a lat-long map)"}};
    }
    if (header.width == header.height && black_outside()) {
        return {EnvMapping::angular,
                "black outside of a circle",
                {size + ", expected 2:1 of a lat-long map; black outside of a circle, so read as "
                        "an angular map (--env-mapping latlong reads a lat-long map)"}};
    }
    std::string note = size + ", expected 2:1; read as a lat-long map";
    if (header.width == header.height) note += " (--env-mapping angular reads a light probe)";
    return {EnvMapping::latlong, "default", {note}};
}

void check_shape(const ExrHeader& header, const MappingChoice& choice) {
    const char* expected = nullptr;
    if (choice.mapping == EnvMapping::cube && !has_shape_of_cube(header)) {
        expected = "N x 6 N pixels of a cube map";
    }
    if (choice.mapping == EnvMapping::angular && header.width != header.height) {
        expected = "N x N pixels of an angular map";
    }
    if (expected == nullptr) return;
    throw_bad_input("expected {} (by {}), got {}; --env-mapping says how to read it", expected,
                    choice.reason, size_text(header));
}

}  // namespace

std::vector<std::pair<std::string, EnvMapping>> env_mapping_names() {
    return {{"auto", EnvMapping::automatic},
            {"latlong", EnvMapping::latlong},
            {"cube", EnvMapping::cube},
            {"angular", EnvMapping::angular}};
}

std::string env_mapping_name(EnvMapping mapping) {
    for (const auto& [name, value] : env_mapping_names()) {
        if (value == mapping) return name;
    }
    return "";
}

MappingChoice choose_mapping(const ExrHeader& header, EnvMapping wanted,
                             const std::function<bool()>& black_outside) {
    MappingChoice choice{wanted, "--env-mapping"};
    if (wanted == EnvMapping::automatic) choice = by_attribute(header);
    if (choice.mapping == EnvMapping::automatic) {
        std::vector<std::string> notes = std::move(choice.notes);
        choice = by_shape(header, black_outside);
        choice.notes.insert(choice.notes.begin(), notes.begin(), notes.end());
    } else if (choice.mapping == EnvMapping::latlong && header.width != 2 * header.height) {
        choice.notes.push_back(fmt::format("{}, expected 2:1; read as a lat-long map by {}",
                                           size_text(header), choice.reason));
    }
    check_shape(header, choice);
    return choice;
}

}  // namespace paim
