// Normals of OBJ text, by tinyobjloader.
#include "compressor/io/obj_parse.h"

#include <algorithm>
#include <istream>
#include <streambuf>
#include <utility>

#include "compressor/io/obj_text.h"
#include "paim/base/error.h"

// A copy of tinyobjloader with double coordinates. Its namespace differs from that of the packaged
// library, so that both can be in one program.
#define tinyobj paim_tinyobj
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace paim {

namespace {

class MemoryBuffer : public std::streambuf {
  public:
    explicit MemoryBuffer(std::span<char> text) {
        setg(text.data(), text.data(), text.data() + text.size());
    }
};

std::vector<Vec3d> to_vectors(const std::vector<tinyobj::real_t>& values) {
    std::vector<Vec3d> vectors(values.size() / 3);
    for (size_t i = 0; i < vectors.size(); ++i) vectors[i] = Vec3d::Map(&values[3 * i]);
    return vectors;
}

}  // namespace

ParsedObj parse_obj(const std::string& name, std::span<char> text, const ObjScan& scan) {
    MemoryBuffer buffer(text);
    std::istream stream(&buffer);
    ParsedObj parsed;
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warnings, errors;
    // Does not triangulate, because the result would depend on the geometry of each pose.
    const bool loaded = tinyobj::LoadObj(&attributes, &shapes, &materials, &warnings, &errors,
                                         &stream, nullptr, false, false);
    if (!loaded) throw_bad_input("{}: tinyobjloader: {}", name, printable(errors));

    std::vector<unsigned char> sizes;  // modulo 256
    std::vector<uint32_t> corners;
    for (const tinyobj::shape_t& shape : shapes) {
        sizes.insert(sizes.end(), shape.mesh.num_face_vertices.begin(),
                     shape.mesh.num_face_vertices.end());
        for (const tinyobj::index_t& corner : shape.mesh.indices) {
            corners.push_back(static_cast<uint32_t>(corner.vertex_index));
            parsed.corner_normals.push_back(corner.normal_index);
        }
    }
    const auto same_size = [](uint32_t a, unsigned char b) {
        return static_cast<unsigned char>(a) == b;
    };
    if (attributes.vertices.size() != size_t{3} * scan.num_vertices ||
        corners != scan.faces.corners ||
        !std::equal(scan.faces.sizes.begin(), scan.faces.sizes.end(), sizes.begin(), sizes.end(),
                    same_size)) {
        throw_bad_input("{}: tinyobjloader read other vertices or faces than are in the file",
                        name);
    }

    parsed.normals = to_vectors(attributes.normals);
    return parsed;
}

}  // namespace paim
