// Triangles and albedo as sections.
#include "paim/format/mesh_sections.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "paim/base/error.h"
#include "paim/format/paim_sections.h"

namespace paim {

SectionSpec triangles_spec(const Topology& topology) {
    return {section::kTriangles,
            ScalarType::u32,
            0,
            {1, static_cast<uint32_t>(topology.triangles.size()), 3}};
}

SectionSpec albedo_spec(const Albedo& albedo) {
    return {
        section::kAlbedo, ScalarType::f32, 0, {1, static_cast<uint32_t>(albedo.values.size()), 3}};
}

void append_mesh(ContainerWriter& writer, size_t triangles_section, size_t albedo_section,
                 const Topology& topology, const Albedo& albedo) {
    writer.append(triangles_section, topology.triangles.data(),
                  topology.triangles.size() * sizeof(Triangle));
    writer.append(albedo_section, albedo.values.data(), albedo.values.size() * sizeof(Vec3f));
}

Topology read_triangles(const ContainerReader& reader, uint32_t num_vertices) {
    const Section& section = reader.require(section::kTriangles, ScalarType::u32);
    if (section.spec.shape[0] != 1 || section.spec.shape[2] != 3) {
        throw_bad_input("{}: triangles: expected 3 indices each, got {}", reader.path(),
                        section.spec.shape[2]);
    }
    const std::vector<uint32_t> indices = reader.read_u32(section);
    for (size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= num_vertices) {
            throw_bad_input("{}: triangle {}: vertex {}, expected 0 to {}", reader.path(), i / 3,
                            indices[i], int64_t{num_vertices} - 1);
        }
    }
    Topology topology{num_vertices, std::vector<Triangle>(indices.size() / 3)};
    if (!indices.empty()) {
        std::memcpy(topology.triangles.data(), indices.data(), indices.size() * sizeof(uint32_t));
    }
    return topology;
}

Albedo read_albedo(const ContainerReader& reader, uint32_t num_vertices) {
    const Section& section = reader.require(section::kAlbedo, ScalarType::f32);
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || (shape[1] != 1 && shape[1] != num_vertices) || shape[2] != 3) {
        throw_bad_input("{}: albedo: {} x {} x {} values, expected 1 or {} colours", reader.path(),
                        shape[0], shape[1], shape[2], num_vertices);
    }
    const std::vector<float> values = reader.read_f32(section);
    check_finite(reader, section::kAlbedo, values);
    Albedo albedo;
    albedo.values.resize(shape[1]);
    for (size_t i = 0; i < albedo.values.size(); ++i) {
        albedo.values[i] = Vec3f(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
    }
    return albedo;
}

void check_finite(const ContainerReader& reader, Tag tag, std::span<const float> values,
                  uint64_t first) {
    const auto bad =
        std::find_if(values.begin(), values.end(), [](float x) { return !std::isfinite(x); });
    if (bad != values.end()) {
        throw_bad_input("{}: section {}: value {} is {}, expected a finite number", reader.path(),
                        tag.str(), first + static_cast<uint64_t>(bad - values.begin()), *bad);
    }
}

}  // namespace paim
