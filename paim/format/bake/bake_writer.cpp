// Writes .bake directories.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/base/half.h"
#include "paim/base/hash.h"
#include "paim/base/json_text.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/bake/bake_manifest.h"
#include "paim/format/container/mesh_section_writer.h"
#include "paim/format/container/sections.h"
#include "paim/format/container/texture_section_writer.h"

namespace paim {

namespace {

std::string pose_metadata(uint64_t bake, uint32_t p, const PoseStatistics& statistics) {
    nlohmann::ordered_json json;
    json["pose"] = p;
    json["bake"] = fmt::format("{:016x}", bake);
    json["rays"] = statistics.rays;
    json["blocked"] = statistics.occluded;
    json["zero_normals"] = statistics.zero_normals;
    json["above_target"] = statistics.above_target;
    if (statistics.back_hits > 0) json["back_hits"] = statistics.back_hits;
    json["transfer_rms"] = statistics.transfer_rms;
    json["noise_rms"] = statistics.noise_rms;
    if (!statistics.gloss_rms.empty()) {
        json["gloss_rms"] = statistics.gloss_rms;
        json["gloss_noise_rms"] = statistics.gloss_noise_rms;
    }
    json["zero_area_faces"] = statistics.mesh.zero_area_faces;
    json["coincident_faces"] = statistics.mesh.coincident_faces;
    return json_text(json, 2) + "\n";
}

// Whether the directory has only files that are written up to the manifest: another process is
// starting the bake now, or was killed while it did.
bool is_only_started(const std::filesystem::path& directory) {
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
        const std::string name = entry.path().filename().string();
        if (name != kMeshName && name != kManifestName && !is_temporary_name(name)) return false;
    }
    return true;
}

// Shapes of the arrays of a pose.
struct PoseShape {
    uint32_t num_vertices;
    uint32_t num_planes;
    uint32_t num_rows;  // of gloss; 0: there is none
    uint32_t num_gloss_planes;
};

PoseShape pose_shape(const BakeIdentity& identity, const Topology& topology,
                     const Materials& materials) {
    PoseShape shape{topology.num_vertices, identity.layout.num_planes(), 0, 0};
    if (!identity.gloss) return shape;
    shape.num_rows = static_cast<uint32_t>(glossy_rows(topology, materials).size());
    shape.num_gloss_planes = identity.gloss->layout.num_planes();
    return shape;
}

void check_shape(const BakedPose& pose, const PoseShape& shape) {
    PAIM_CHECK_EQ(pose.transfer.size(), size_t{shape.num_planes} * shape.num_vertices);
    PAIM_CHECK_EQ(pose.noise.size(), pose.transfer.size());
    PAIM_CHECK_EQ(pose.gloss.size(), size_t{shape.num_gloss_planes} * shape.num_rows);
    PAIM_CHECK_EQ(pose.gloss_noise.size(), pose.gloss.size());
}

std::vector<SectionPlan> pose_specs(const std::string& metadata, const PoseShape& shape) {
    const auto planes = [](Tag tag, uint32_t count, uint32_t num_points,
                           ScalarType type = ScalarType::f32) {
        return SectionSpec{tag, type, 0, {1, count, num_points}};
    };
    const uint32_t num_vertices = shape.num_vertices;
    std::vector<SectionPlan> specs{
        SectionSpec{
            section::kMetadata, ScalarType::u8, 0, {1, 1, static_cast<uint32_t>(metadata.size())}},
        planes(section::kPositions, 3, num_vertices), planes(section::kNormals, 3, num_vertices),
        planes(section::kTransfer, shape.num_planes, num_vertices),
        planes(section::kNoise, shape.num_planes, num_vertices, ScalarType::f16)};
    if (shape.num_rows == 0) return specs;
    specs.push_back(planes(section::kGloss, shape.num_gloss_planes, shape.num_rows));
    specs.push_back(
        planes(section::kGlossNoise, shape.num_gloss_planes, shape.num_rows, ScalarType::f16));
    return specs;
}

void append_halves(ContainerWriter& writer, size_t section, const std::vector<float>& values) {
    std::vector<uint16_t> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(), to_half);
    writer.append(section, std::span<const uint16_t>(halves));
}

// Fills the sections of pose_specs(), which are the first ones.
void append_pose(ContainerWriter& writer, const std::string& metadata, const BakedPose& pose) {
    writer.append(0, metadata.data(), metadata.size());
    writer.append(1, std::span(pose.positions));
    writer.append(2, std::span(pose.normals));
    writer.append(3, std::span(pose.transfer));
    append_halves(writer, 4, pose.noise);
    if (pose.gloss.empty()) return;
    writer.append(5, std::span(pose.gloss));
    append_halves(writer, 6, pose.gloss_noise);
}

// What poses share, or a still mesh has.
struct MeshParts {
    const Topology& topology;
    const Albedo& albedo;
    const Texture& texture;
    const Materials* materials;  // of bakes with gloss, as the identity lists them; else nullptr
};

// Adds the sections of a mesh behind others.
void add_mesh_specs(const MeshParts& mesh, std::vector<SectionPlan>& specs) {
    specs.push_back(triangles_spec(mesh.topology));
    specs.push_back(albedo_spec(mesh.albedo));
    if (mesh.materials != nullptr) {
        const auto count = static_cast<uint32_t>(mesh.materials->of_vertex.size());
        specs.push_back(SectionSpec{section::kMaterials, ScalarType::u32, 0, {1, count, 1}});
    }
    for (const TextureSection& section : texture_sections(mesh.texture, section::kTexture[0])) {
        specs.emplace_back(section.spec);
    }
}

// Fills them.
// first  their first section
void append_mesh(ContainerWriter& writer, size_t first, const MeshParts& mesh) {
    append_mesh(writer, first, first + 1, mesh.topology, mesh.albedo);
    first += 2;
    if (mesh.materials != nullptr) {
        const std::vector<uint16_t>& listed = mesh.materials->of_vertex;
        const std::vector<uint32_t> numbers(listed.begin(), listed.end());
        writer.append(first++, std::span(numbers));
    }
    for (const auto& [piece, spec] : texture_sections(mesh.texture, section::kTexture[0])) {
        const std::vector<uint8_t> bytes =
            texture_bytes(mesh.texture, mesh.topology, piece, spec.index);
        writer.append(first++, bytes.data(), bytes.size());
    }
}

// The same materials by their numbers in the identity's list.
Materials as_listed(const Materials& materials, const BakeIdentity& identity) {
    if (!identity.gloss) return {};
    Materials listed{identity.gloss->materials, materials.of_vertex};
    for (uint16_t& number : listed.of_vertex) {
        if (number == 0) continue;
        const auto found =
            std::find(listed.glossy.begin(), listed.glossy.end(), materials.glossy[number - 1u]);
        PAIM_CHECK(found != listed.glossy.end());
        number = static_cast<uint16_t>(found - listed.glossy.begin() + 1);
    }
    return listed;
}

}  // namespace

uint64_t mesh_checksum(const Topology& topology, const Albedo& albedo, const Texture& texture,
                       const Materials& materials) {
    StreamingHash hash;
    hash.update(&topology.num_vertices, sizeof(topology.num_vertices));
    hash.update(topology.triangles.data(), topology.triangles.size() * sizeof(Triangle));
    hash.update(albedo.values.data(), albedo.values.size() * sizeof(Vec3f));
    const auto is_glossy = [](uint16_t number) { return number > 0; };
    if (std::any_of(materials.of_vertex.begin(), materials.of_vertex.end(), is_glossy)) {
        hash.update(materials.of_vertex.data(), materials.of_vertex.size() * sizeof(uint16_t));
    }
    for (const auto& [piece, spec] : texture_sections(texture, section::kTexture[0])) {
        const std::vector<uint8_t> bytes = texture_bytes(texture, topology, piece, spec.index);
        const uint64_t size_bytes = bytes.size();
        hash.update(&size_bytes, sizeof size_bytes);
        hash.update(bytes.data(), bytes.size());
    }
    return hash.digest();
}

std::filesystem::path bake_still_mesh_file(const std::filesystem::path& directory) {
    return directory / "scenery.bin";
}

std::filesystem::path bake_pose_file(const std::filesystem::path& directory, uint32_t p) {
    return directory / fmt::format("pose_{:06}.bin", p);
}

BakeWriter::BakeWriter(std::filesystem::path directory, const BakeIdentity& identity,
                       const Topology& topology, const Albedo& albedo, const Texture& texture,
                       const Materials& materials)
    : directory_(std::move(directory)), identity_(identity) {
    const Materials listed = as_listed(materials, identity_);
    num_gloss_rows_ = pose_shape(identity_, topology, listed).num_rows;
    for (auto& source : identity_.poses) source.name = as_manifest_text(source.name);
    for (auto& source : identity_.still_meshes) source.name = as_manifest_text(source.name);
    identity_checksum_ = identity_checksum(identity_);
    const std::filesystem::path manifest = directory_ / kManifestName;
    const std::string text = manifest_text(identity_);
    parse_manifest(text, manifest.string());  // what readers would refuse is not written
    if (std::filesystem::exists(manifest)) {
        const std::string difference = first_difference(read_manifest(manifest), identity_);
        if (!difference.empty()) {
            throw_bad_input("{}: holds another bake ({}); choose another output or remove it",
                            directory_.string(), difference);
        }
    } else if (std::filesystem::is_directory(directory_) && !is_only_started(directory_)) {
        throw_bad_input("{}: is not empty and not a bake (no manifest.json)", directory_.string());
    }
    ensure_directory(directory_);
    remove_abandoned_files(directory_);
    // The manifest is written last, so that a directory with a manifest has a mesh.
    const MeshParts parts{topology, albedo, texture, identity_.gloss ? &listed : nullptr};
    std::vector<SectionPlan> specs;
    add_mesh_specs(parts, specs);
    ContainerWriter mesh(directory_ / kMeshName, section::kKindMesh, specs);
    append_mesh(mesh, 0, parts);
    mesh.commit();
    write_file(manifest, text);
}

bool BakeWriter::has_pose(uint32_t p) const {
    const std::filesystem::path path = bake_pose_file(directory_, p);
    if (!std::filesystem::exists(path)) return false;
    try {
        read_statistics(p);
        ContainerReader(path, section::kKindPose).verify_all();
        return true;
    } catch (const Error&) {
        return false;  // damaged or of another bake or pose: it is baked again
    }
}

bool BakeWriter::has_still_mesh() const {
    if (!std::filesystem::exists(bake_still_mesh_file(directory_))) return false;
    try {
        read_bake_still_mesh(directory_, identity_checksum_, identity_);
        return true;
    } catch (const Error&) {
        return false;
    }
}

void BakeWriter::write_pose(uint32_t p, const BakedPose& pose) const {
    const uint32_t num_gloss_planes =
        num_gloss_rows_ > 0 ? identity_.gloss->layout.num_planes() : 0;
    const PoseShape shape{identity_.num_vertices, identity_.layout.num_planes(), num_gloss_rows_,
                          num_gloss_planes};
    check_shape(pose, shape);
    const std::string metadata = pose_metadata(identity_checksum_, p, pose.statistics);
    ContainerWriter writer(bake_pose_file(directory_, p), section::kKindPose,
                           pose_specs(metadata, shape));
    append_pose(writer, metadata, pose);
    writer.commit();
}

void BakeWriter::write_still_mesh(const BakedStillMesh& still_mesh) const {
    const Materials listed = as_listed(still_mesh.materials, identity_);
    const PoseShape shape = pose_shape(identity_, still_mesh.topology, listed);
    check_shape(still_mesh.pose, shape);
    const std::string metadata =
        pose_metadata(identity_checksum_, kStillMeshPose, still_mesh.pose.statistics);
    std::vector<SectionPlan> specs = pose_specs(metadata, shape);
    const size_t first = specs.size();
    const MeshParts parts{still_mesh.topology, still_mesh.albedo, still_mesh.texture,
                          identity_.gloss ? &listed : nullptr};
    add_mesh_specs(parts, specs);
    ContainerWriter writer(bake_still_mesh_file(directory_), section::kKindMesh, specs);
    append_pose(writer, metadata, still_mesh.pose);
    append_mesh(writer, first, parts);
    writer.commit();
}

}  // namespace paim
