// The diffuse part of material libraries.
#include "compressor/io/obj_materials.h"

#include <fmt/format.h>

#include <charconv>

#include "compressor/io/obj_text.h"
#include "paim/base/error.h"

namespace paim {

namespace {

// "r g b", or one number for all three.
Vec3d read_color(ObjText& text) {
    Vec3d color = Vec3d::Zero();
    int num_values = 0;
    for (; num_values < 3 && text.find_word(); ++num_values) {
        const char* start = text.position();
        text.skip_number("Kd");
        if (*start == '+') ++start;
        std::from_chars(start, text.position(), color[num_values]);
    }
    if (num_values == 1) color.setConstant(color[0]);
    if (num_values == 0 || num_values == 2) {
        text.fail(fmt::format("Kd: expected 3 numbers, got {}", num_values));
    }
    return color;
}

}  // namespace

std::vector<ObjMaterial> parse_obj_materials(const std::string& name, std::span<char> data,
                                             std::vector<std::string>& warnings) {
    std::vector<ObjMaterial> materials;
    ObjText text(name, data);
    for (; !text.at_end(); text.next_line()) {
        const std::string_view keyword = text.read_keyword();
        if (keyword == "newmtl") {
            materials.push_back({std::string(text.read_rest_of_line()), std::nullopt, {}});
        } else if (keyword == "Kd" && !materials.empty()) {
            try {
                materials.back().diffuse = read_color(text);
            } catch (const Error& error) {
                warnings.emplace_back(error.what());
            }
        } else if (keyword == "map_Kd" && !materials.empty()) {
            materials.back().diffuse_texture = printable(text.read_rest_of_line());
        }
    }
    return materials;
}

}  // namespace paim
