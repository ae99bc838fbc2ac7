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

std::vector<SectionPlan> pose_specs(const std::string& metadata, uint32_t num_vertices,
                                    uint32_t num_planes) {
    const auto planes = [&](Tag tag, uint32_t count) {
        return SectionSpec{tag, ScalarType::f32, 0, {1, count, num_vertices}};
    };
    return {
        SectionSpec{
            section::kMetadata, ScalarType::u8, 0, {1, 1, static_cast<uint32_t>(metadata.size())}},
        planes(section::kPositions, 3), planes(section::kNormals, 3),
        planes(section::kTransfer, num_planes),
        SectionSpec{section::kNoise, ScalarType::f16, 0, {1, num_planes, num_vertices}}};
}

// Fills the sections of pose_specs(), which are the first ones.
void append_pose(ContainerWriter& writer, const std::string& metadata, const BakedPose& pose) {
    writer.append(0, metadata.data(), metadata.size());
    writer.append(1, std::span(pose.positions));
    writer.append(2, std::span(pose.normals));
    writer.append(3, std::span(pose.transfer));
    std::vector<uint16_t> noise(pose.noise.size());
    std::transform(pose.noise.begin(), pose.noise.end(), noise.begin(), to_half);
    writer.append(4, std::span<const uint16_t>(noise));
}

// Adds the sections of a texture to the plans of a mesh.
void add_texture(const Texture& texture, std::vector<SectionPlan>& plans) {
    for (const TextureSection& section : texture_sections(texture, section::kTexture[0])) {
        plans.emplace_back(section.spec);
    }
}

// Fills them. They are the last of `num_plans` sections.
void append_texture(ContainerWriter& writer, size_t num_plans, const Topology& topology,
                    const Texture& texture) {
    const auto sections = texture_sections(texture, section::kTexture[0]);
    const size_t first = num_plans - sections.size();
    for (size_t i = 0; i < sections.size(); ++i) {
        const std::vector<uint8_t> bytes =
            texture_bytes(texture, topology, sections[i].piece, sections[i].spec.index);
        writer.append(first + i, bytes.data(), bytes.size());
    }
}

void write_mesh(const std::filesystem::path& path, const Topology& topology, const Albedo& albedo,
                const Texture& texture) {
    std::vector<SectionPlan> plans{triangles_spec(topology), albedo_spec(albedo)};
    add_texture(texture, plans);
    ContainerWriter writer(path, section::kKindMesh, plans);
    append_mesh(writer, 0, 1, topology, albedo);
    append_texture(writer, plans.size(), topology, texture);
    writer.commit();
}

}  // namespace

uint64_t mesh_checksum(const Topology& topology, const Albedo& albedo, const Texture& texture) {
    StreamingHash hash;
    hash.update(&topology.num_vertices, sizeof(topology.num_vertices));
    hash.update(topology.triangles.data(), topology.triangles.size() * sizeof(Triangle));
    hash.update(albedo.values.data(), albedo.values.size() * sizeof(Vec3f));
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
                       const Topology& topology, const Albedo& albedo, const Texture& texture)
    : directory_(std::move(directory)), identity_(identity) {
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
    write_mesh(directory_ / kMeshName, topology, albedo, texture);
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
        read_bake_still_mesh(directory_, identity_checksum_, identity_.layout);
        return true;
    } catch (const Error&) {
        return false;
    }
}

void BakeWriter::write_pose(uint32_t p, const BakedPose& pose) const {
    const uint32_t num_planes = identity_.layout.num_planes();
    PAIM_CHECK_EQ(pose.transfer.size(), size_t{num_planes} * identity_.num_vertices);
    PAIM_CHECK_EQ(pose.noise.size(), pose.transfer.size());
    const std::string metadata = pose_metadata(identity_checksum_, p, pose.statistics);
    ContainerWriter writer(bake_pose_file(directory_, p), section::kKindPose,
                           pose_specs(metadata, identity_.num_vertices, num_planes));
    append_pose(writer, metadata, pose);
    writer.commit();
}

void BakeWriter::write_still_mesh(const BakedStillMesh& still_mesh) const {
    const uint32_t num_vertices = still_mesh.topology.num_vertices;
    const uint32_t num_planes = identity_.layout.num_planes();
    PAIM_CHECK_EQ(still_mesh.pose.transfer.size(), size_t{num_planes} * num_vertices);
    PAIM_CHECK_EQ(still_mesh.pose.noise.size(), still_mesh.pose.transfer.size());
    const std::string metadata =
        pose_metadata(identity_checksum_, kStillMeshPose, still_mesh.pose.statistics);
    std::vector<SectionPlan> specs = pose_specs(metadata, num_vertices, num_planes);
    specs.push_back(triangles_spec(still_mesh.topology));
    specs.push_back(albedo_spec(still_mesh.albedo));
    add_texture(still_mesh.texture, specs);
    ContainerWriter writer(bake_still_mesh_file(directory_), section::kKindMesh, specs);
    append_pose(writer, metadata, still_mesh.pose);
    append_mesh(writer, 5, 6, still_mesh.topology, still_mesh.albedo);
    append_texture(writer, specs.size(), still_mesh.topology, still_mesh.texture);
    writer.commit();
}

}  // namespace paim
