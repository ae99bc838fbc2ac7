// The diffuse and the glossy part of material libraries.
#include "compressor/io/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "compressor/io/obj_text.h"
#include "paim/base/error.h"

namespace paim {

namespace {

// "r g b", or one number for all three.
Vec3d read_color(ObjText& text, const char* keyword) {
    Vec3d color = Vec3d::Zero();
    int num_values = 0;
    for (; num_values < 3 && text.find_word(); ++num_values) {
        color[num_values] = text.read_number(keyword);
    }
    if (num_values == 1) color.setConstant(color[0]);
    if (num_values == 0 || num_values == 2) {
        text.fail(fmt::format("{}: expected 3 numbers, got {}", keyword, num_values));
    }
    return color;
}

double read_one_number(ObjText& text, const char* keyword) {
    if (!text.find_word()) text.fail(fmt::format("{}: expected a number, got none", keyword));
    return text.read_number(keyword);
}

struct ColorLine {
    const char* keyword;
    std::optional<Vec3d> ObjMaterial::*value;
};
constexpr ColorLine kColors[] = {{"Kd", &ObjMaterial::diffuse}, {"Ks", &ObjMaterial::specular}};

struct NumberLine {
    const char* keyword;
    std::optional<double> ObjMaterial::*value;
};
constexpr NumberLine kNumbers[] = {{"Ns", &ObjMaterial::exponent},
                                   {"illum", &ObjMaterial::illumination},
                                   {"Pr", &ObjMaterial::roughness},
                                   {"Pm", &ObjMaterial::metallic}};

bool is_glossy(std::string_view keyword) {
    const auto has_keyword = [&](const NumberLine& line) { return keyword == line.keyword; };
    return keyword == "Ks" || std::any_of(std::begin(kNumbers), std::end(kNumbers), has_keyword);
}

// Reads the rest of a line within a material.
void read_line(std::string_view keyword, ObjText& text, ObjMaterial& material) {
    for (const ColorLine& line : kColors) {
        if (keyword == line.keyword) material.*line.value = read_color(text, line.keyword);
    }
    for (const NumberLine& line : kNumbers) {
        if (keyword == line.keyword) material.*line.value = read_one_number(text, line.keyword);
    }
    if (keyword == "map_Kd") material.map = parse_texture_map(text.read_rest_of_line());
}

}  // namespace

std::vector<ObjMaterial> parse_obj_materials(const std::string& name, std::span<char> data,
                                             bool gloss, std::vector<std::string>& warnings) {
    std::vector<ObjMaterial> materials;
    ObjText text(name, data);
    for (; !text.at_end(); text.next_line()) {
        const std::string_view keyword = text.read_keyword();
        if (keyword == "newmtl") {
            materials.emplace_back().name = text.read_rest_of_line();
        } else if (!materials.empty()) {
            try {
                read_line(keyword, text, materials.back());
            } catch (const Error& error) {
                if (gloss || !is_glossy(keyword)) warnings.emplace_back(error.what());
            }
        }
    }
    return materials;
}

}  // namespace paim
