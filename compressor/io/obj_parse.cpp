// Parsing through tinyobjloader.
#include "compressor/io/obj_parse.h"

#include <fmt/format.h>

#include <istream>
#include <map>
#include <set>
#include <sstream>
#include <streambuf>
#include <utility>

#include "compressor/io/obj_text.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/file.h"

// A copy of tinyobjloader with double coordinates. Its namespace differs from that of the packaged
// library, so that both can be in one program.
#define tinyobj paim_tinyobj
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace paim {

namespace {

// Limit of all material libraries of one OBJ together. Scenes have far less.
constexpr uint64_t kMaxMaterialBytes = uint64_t{4} << 20;
constexpr size_t kMaxWarnings = 8;

class MemoryBuffer : public std::streambuf {
  public:
    explicit MemoryBuffer(std::span<char> text) {
        setg(text.data(), text.data(), text.data() + text.size());
    }
};

// Replaces tinyobjloader's reader of material libraries, which would read any path that the file
// names, such as devices and huge files, and does not distinguish a black Kd from none.
class MaterialReader : public tinyobj::MaterialReader {
  public:
    MaterialReader(std::filesystem::path folder, ParsedObj& parsed)
        : folder_(std::move(folder)), parsed_(parsed) {}

    bool operator()(const std::string& file, std::vector<tinyobj::material_t>*,
                    std::map<std::string, int>* indices, std::string*, std::string*) override {
        if (file.empty()) return false;  // two spaces between names
        try {
            const std::filesystem::path path = folder_ / file;
            std::vector<char> text = read_file(path, kMaxMaterialBytes - num_bytes_);
            num_bytes_ += text.size();
            for (ObjMaterial& material :
                 parse_obj_materials(path.string(), text, parsed_.warnings)) {
                indices->emplace(material.name, static_cast<int>(parsed_.materials.size()));
                parsed_.materials.push_back(std::move(material));
            }
            return true;
        } catch (const Error& error) {
            parsed_.warnings.emplace_back(error.what());
            return false;
        }
    }

  private:
    std::filesystem::path folder_;
    ParsedObj& parsed_;
    uint64_t num_bytes_ = 0;
};

// Counts the usemtl names that tinyobjloader did not find. Its other messages are about unused
// data, or repeat ours.
void warn_about_unknown_materials(const std::string& name, const std::string& library_warnings,
                                  std::vector<std::string>& warnings) {
    std::set<std::string> unknown;
    std::string first;
    std::istringstream lines(library_warnings);
    for (std::string line; std::getline(lines, line);) {
        const std::string start = "material [ '", end = "' ] not found";
        const size_t stop = line.rfind(end);
        if (!line.starts_with(start) || stop == std::string::npos) continue;
        const std::string material = line.substr(start.size(), stop - start.size());
        if (unknown.empty()) first = material;
        unknown.insert(material);
    }
    if (unknown.empty()) return;
    warnings.push_back(fmt::format("{}: {} materials not found in any .mtl file, e.g. '{}'", name,
                                   unknown.size(), printable(first)));
}

// Removes repeated warnings, and shortens a long list.
void shorten_warnings(const std::string& name, std::vector<std::string>& warnings) {
    std::set<std::string> seen;
    std::erase_if(warnings, [&](const std::string& text) { return !seen.insert(text).second; });
    if (warnings.size() <= kMaxWarnings) return;
    const size_t num_more = warnings.size() - kMaxWarnings;
    warnings.resize(kMaxWarnings);
    warnings.push_back(fmt::format("{}: {} more warnings about material files", name, num_more));
}

std::vector<Vec3d> to_vectors(const std::vector<tinyobj::real_t>& values) {
    std::vector<Vec3d> vectors(values.size() / 3);
    for (size_t i = 0; i < vectors.size(); ++i) vectors[i] = Vec3d::Map(&values[3 * i]);
    return vectors;
}

}  // namespace

ParsedObj parse_obj(const std::string& name, std::span<char> text, const ObjScan& scan,
                    const ObjParseOptions& options) {
    MemoryBuffer buffer(text);
    std::istream stream(&buffer);
    ParsedObj parsed;
    MaterialReader reader(options.material_folder, parsed);
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warnings, errors;
    // Does not triangulate, because the result would depend on the geometry of each pose.
    const bool loaded =
        tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors, &stream,
                         options.read_materials ? &reader : nullptr, false, false);
    if (!loaded) throw_bad_input("{}: tinyobjloader: {}", name, printable(errors));

    Polygons faces;
    for (const tinyobj::shape_t& shape : shapes) {
        for (const auto size : shape.mesh.num_face_vertices) {
            faces.sizes.push_back(static_cast<uint8_t>(size));
        }
        for (const tinyobj::index_t& corner : shape.mesh.indices) {
            faces.corners.push_back(static_cast<uint32_t>(corner.vertex_index));
            parsed.corner_normals.push_back(corner.normal_index);
        }
        parsed.face_materials.insert(parsed.face_materials.end(), shape.mesh.material_ids.begin(),
                                     shape.mesh.material_ids.end());
    }
    if (attributes.vertices.size() != size_t{3} * scan.num_vertices || faces != scan.faces) {
        throw_bad_input("{}: tinyobjloader read other vertices or faces than are in the file",
                        name);
    }

    PAIM_CHECK_EQ(scan.positions.size(), size_t{scan.num_vertices});
    parsed.positions = scan.positions;
    parsed.normals = to_vectors(attributes.normals);
    if (scan.has_colors) parsed.colors = to_vectors(attributes.colors);
    if (options.read_materials) {
        shorten_warnings(name, parsed.warnings);
        warn_about_unknown_materials(name, warnings, parsed.warnings);
    }
    return parsed;
}

}  // namespace paim
