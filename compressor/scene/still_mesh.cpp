// Still meshes among the poses, which block their light and bounce it.
#include "compressor/scene/still_mesh.h"

#include <filesystem>
#include <limits>

#include "compressor/scene/isolated_at_rest.h"
#include "paim/base/error.h"
#include "paim/base/hash.h"

namespace paim {

namespace {

// Checksum of everything that is seen: faces, albedo, texture, positions, normals and, if any vertex is
// glossy, materials.
uint64_t checksum(const PoseSource& source, const Pose& pose) {
    const uint64_t mesh = mesh_checksum(source.topology(), source.albedo(), source.texture());
    StreamingHash hash;
    hash.update(&mesh, sizeof mesh);
    hash.update(pose.positions.data(), pose.positions.size() * sizeof(Vec3f));
    hash.update(pose.normals.data(), pose.normals.size() * sizeof(Vec3f));
    if (const Materials& materials = source.materials(); !materials.empty()) {
        hash.update(materials.of_vertex.data(), materials.of_vertex.size() * sizeof(uint16_t));
        for (const GlossMaterial& material : materials.glossy) {
            hash.update(material.brdf.data(), material.brdf.size());
            hash.update(material.tint.data(), sizeof(Vec3f));
        }
    }
    return hash.digest();
}

// Error if both textures together are too much for one.
void check_sum(const Texture& there, const Texture& added, const std::string& name) {
    const size_t num_images = there.images.size() + added.images.size();
    const size_t num_coordinates = there.coordinates.size() + added.coordinates.size();
    if (num_images <= kMaxImages && num_coordinates <= kMaxCoordinates) return;
    throw_bad_input(
        "{}: with it, still meshes have {} images and {} texture coordinates, expected "
        "at most {} and {}",
        name, num_images, num_coordinates, kMaxImages, kMaxCoordinates);
}

}  // namespace

void StillMesh::add(const PoseSource& given) {
    const IsolatedAtRest source(given);
    const Pose own = load_from_origin(source, 0);
    const uint32_t num_own = source.topology().num_vertices;
    const std::string name = source.pose_name(0);
    if (num_own > std::numeric_limits<int32_t>::max() - topology.num_vertices) {
        throw_bad_input("{}: {} vertices are too many to add to {}", name, num_own,
                        topology.num_vertices);
    }
    // The name without its folder, so that a bake does not depend on the place of the files.
    sources.push_back({std::filesystem::path(name).filename().string(), checksum(source, own)});
    if (empty()) {
        albedo = source.albedo();
        materials = source.materials();
    } else {
        albedo.append(source.albedo(), topology.num_vertices, num_own);
        materials.append(source.materials(), topology.num_vertices, num_own);
    }
    check_sum(texture, source.texture(), name);
    texture.append(source.texture(), topology.triangles.size(), source.topology().triangles.size());
    topology.append(source.topology());
    pose.positions.insert(pose.positions.end(), own.positions.begin(), own.positions.end());
    pose.normals.insert(pose.normals.end(), own.normals.begin(), own.normals.end());
}

}  // namespace paim
