// Writes triangles and albedo as sections of .paim and .bake files.
#include "paim/format/container/mesh_section_writer.h"

namespace paim {

SectionSpec triangles_spec(const Topology& topology, Tag tag) {
    return {tag, ScalarType::u32, 0, {1, static_cast<uint32_t>(topology.triangles.size()), 3}};
}

SectionSpec albedo_spec(const Albedo& albedo, Tag tag) {
    return {tag, ScalarType::f32, 0, {1, static_cast<uint32_t>(albedo.values.size()), 3}};
}

void append_mesh(ContainerWriter& writer, size_t triangles_section, size_t albedo_section,
                 const Topology& topology, const Albedo& albedo) {
    writer.append(triangles_section, topology.triangles.data(),
                  topology.triangles.size() * sizeof(Triangle));
    writer.append(albedo_section, albedo.values.data(), albedo.values.size() * sizeof(Vec3f));
}

}  // namespace paim
