// Reads .bake directories.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "paim/base/error.h"
#include "paim/base/parallel.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/bake/bake_manifest.h"
#include "paim/format/container/mesh_sections.h"
#include "paim/format/container/metadata.h"
#include "paim/format/container/root_numbers.h"
#include "paim/format/container/sections.h"
#include "paim/format/container/texture_sections.h"

namespace paim {

namespace {

const Section& require_planes(const ContainerReader& reader, Tag tag, uint32_t num_planes,
                              uint32_t num_vertices, ScalarType type = ScalarType::f32) {
    const Section& section = reader.require(tag, type);
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || shape[1] != num_planes || shape[2] != num_vertices) {
        throw_bad_input("{}: section {}: {} x {} x {} values, expected {} x {}", reader.name(),
                        tag.str(), shape[0], shape[1], shape[2], num_planes, num_vertices);
    }
    return section;
}

PoseStatistics read_statistics_of(const ContainerReader& reader, uint64_t identity_checksum,
                                  uint32_t p, const BakeIdentity& identity) {
    const Metadata metadata(reader.read_text(reader.require(section::kMetadata, ScalarType::u8)),
                            reader.name());
    const std::string bake = fmt::format("{:016x}", identity_checksum);
    if (metadata.text("bake") != bake) {
        throw_bad_input("{}: belongs to bake {}, expected {}", reader.name(), metadata.text("bake"),
                        bake);
    }
    metadata.integer("pose", p, p);
    constexpr double kMaxExact = 9007199254740992.0;  // 2^53
    constexpr double kMax = std::numeric_limits<double>::max();
    PoseStatistics statistics;
    statistics.rays = static_cast<uint64_t>(metadata.number("rays", 0.0, kMaxExact));
    statistics.occluded = static_cast<uint64_t>(metadata.number("blocked", 0.0, kMaxExact));
    statistics.zero_normals =
        metadata.integer("zero_normals", 0, std::numeric_limits<int32_t>::max());
    statistics.above_target =
        metadata.integer("above_target", 0, std::numeric_limits<int32_t>::max());
    if (metadata.root().contains("back_hits")) {
        statistics.back_hits = static_cast<uint64_t>(metadata.number("back_hits", 0.0, kMaxExact));
    }
    const uint32_t bands = identity.layout.in_bands;
    statistics.transfer_rms = metadata.numbers("transfer_rms", bands, 0.0, kMax);
    statistics.noise_rms = metadata.numbers("noise_rms", bands, 0.0, kMax);
    if (identity.gloss) {
        const uint32_t gloss_bands = identity.gloss->layout.in_bands;
        statistics.gloss_rms = metadata.numbers("gloss_rms", gloss_bands, 0.0, kMax);
        statistics.gloss_noise_rms = metadata.numbers("gloss_noise_rms", gloss_bands, 0.0, kMax);
    }
    statistics.mesh.zero_area_faces = metadata.count("zero_area_faces");
    statistics.mesh.coincident_faces = metadata.count("coincident_faces");
    return statistics;
}

Materials read_materials(const ContainerReader& reader, const BakeIdentity& identity,
                         uint32_t num_vertices) {
    if (!identity.gloss) return {};
    const Section& section = reader.require(section::kMaterials, ScalarType::u32);
    const auto& shape = section.spec.shape;
    if (shape[0] != 1 || (shape[1] != 1 && shape[1] != num_vertices) || shape[2] != 1) {
        throw_bad_input("{}: materials: {} x {} x {} values, expected 1 or {}", reader.name(),
                        shape[0], shape[1], shape[2], num_vertices);
    }
    Materials materials{identity.gloss->materials, {}};
    for (const uint32_t number : reader.read_u32(section)) {
        if (number > materials.glossy.size()) {
            throw_bad_input("{}: materials: number {}, expected 0 to {}", reader.name(), number,
                            materials.glossy.size());
        }
        materials.of_vertex.push_back(static_cast<uint16_t>(number));
    }
    return materials;
}

// The checks of read_pose(), without the whole section in memory.
void verify_planes(const ContainerReader& reader, const Section& section) {
    reader.verify(section);
    constexpr uint64_t kPiece = 1 << 18;  // 1 MB
    const uint64_t num_values = section.spec.num_values();
    std::vector<float> piece;
    for (uint64_t first = 0; first < num_values; first += piece.size()) {
        piece.resize(std::min(kPiece, num_values - first));
        reader.read_range(section, first, piece.size(), piece.data());
        check_finite(reader, section.spec.tag, piece, first);
    }
}

}  // namespace

bool is_bake(const std::filesystem::path& directory) {
    std::error_code ignored;
    return std::filesystem::exists(directory / kManifestName, ignored);
}

BakeReader::BakeReader(std::filesystem::path directory) : directory_(std::move(directory)) {
    // The path "x.bake/" has no filename; "x.bake" has one.
    if (!directory_.has_filename()) directory_ = directory_.parent_path();
    if (!std::filesystem::is_directory(directory_)) {
        throw_bad_input("{}: expected a .bake directory, got {}", directory_.string(),
                        std::filesystem::exists(directory_) ? "a file" : "nothing of that name");
    }
    if (!is_bake(directory_)) {
        throw_bad_input("{}: expected a .bake directory, got one without manifest.json",
                        directory_.string());
    }
    identity_ = read_manifest(directory_ / kManifestName);
    identity_checksum_ = identity_checksum(identity_);
    const ContainerReader mesh(directory_ / kMeshName, section::kKindMesh);
    topology_ = read_triangles(mesh, identity_.num_vertices);
    albedo_ = read_albedo(mesh, identity_.num_vertices);
    materials_ = read_materials(mesh, identity_, identity_.num_vertices);
    if (identity_.gloss) gloss_rows_ = glossy_rows(topology_, materials_);
    texture_ = read_texture(mesh, topology_, section::kTexture[0]);
    if (mesh_checksum(topology_, albedo_, texture_, materials_) != identity_.mesh_xxh3) {
        throw_bad_input("{}: not the mesh that the manifest names", mesh.name());
    }
    check_floor(topology_, identity_.num_following, mesh.name());
    if (!identity_.still_meshes.empty()) {
        still_mesh_ = read_bake_still_mesh(directory_, identity_checksum_, identity_);
    }
    uint32_t num_missing = 0;
    uint32_t first_missing = 0;
    for (uint32_t p = num_poses(); p-- > 0;) {
        if (std::filesystem::exists(bake_pose_file(directory_, p))) continue;
        ++num_missing;
        first_missing = p;
    }
    if (num_missing > 0) {
        throw_bad_input("{}: {} of {} poses are missing, the first is {}; bake them first",
                        directory_.string(), num_missing, num_poses(), first_missing);
    }
    // Before memory is taken for the manifest's number of vertices, a pose must have as many.
    const ContainerReader pose(bake_pose_file(directory_, 0), section::kKindPose);
    read_statistics_of(pose, identity_checksum_, 0, identity_);
    require_planes(pose, section::kPositions, 3, identity_.num_vertices);
    require_planes(pose, section::kTransfer, identity_.layout.num_planes(), identity_.num_vertices);
}

uint64_t BakeReader::size_bytes() const {
    uint64_t total = std::filesystem::file_size(directory_ / kManifestName) +
                     std::filesystem::file_size(directory_ / kMeshName);
    if (still_mesh_) total += std::filesystem::file_size(bake_still_mesh_file(directory_));
    for (uint32_t p = 0; p < num_poses(); ++p) {
        total += std::filesystem::file_size(bake_pose_file(directory_, p));
    }
    return total;
}

PoseStatistics read_bake_statistics(const std::filesystem::path& directory,
                                    uint64_t identity_checksum, uint32_t p,
                                    const BakeIdentity& identity) {
    const ContainerReader reader(bake_pose_file(directory, p), section::kKindPose);
    return read_statistics_of(reader, identity_checksum, p, identity);
}

BakedStillMesh read_bake_still_mesh(const std::filesystem::path& directory,
                                    uint64_t identity_checksum, const BakeIdentity& identity) {
    const ContainerReader reader(bake_still_mesh_file(directory), section::kKindMesh);
    BakedStillMesh still_mesh;
    BakedPose& pose = still_mesh.pose;
    pose.statistics = read_statistics_of(reader, identity_checksum, kStillMeshPose, identity);
    const uint32_t num_vertices = count_vertices(reader, section::kPositions);
    const uint32_t num_planes = identity.layout.num_planes();
    pose.positions = read_planes(reader, section::kPositions, 3, num_vertices);
    pose.normals = read_planes(reader, section::kNormals, 3, num_vertices);
    pose.transfer = read_planes(reader, section::kTransfer, num_planes, num_vertices);
    pose.noise = read_planes(reader, section::kNoise, num_planes, num_vertices, ScalarType::f16);
    still_mesh.topology = read_triangles(reader, num_vertices);
    still_mesh.albedo = read_albedo(reader, num_vertices);
    still_mesh.texture = read_texture(reader, still_mesh.topology, section::kTexture[0]);
    still_mesh.materials = read_materials(reader, identity, num_vertices);
    if (!identity.gloss) return still_mesh;
    const auto num_rows =
        static_cast<uint32_t>(glossy_rows(still_mesh.topology, still_mesh.materials).size());
    if (num_rows == 0) return still_mesh;
    const uint32_t num_gloss = identity.gloss->layout.num_planes();
    pose.gloss = read_planes(reader, section::kGloss, num_gloss, num_rows);
    pose.gloss_noise =
        read_planes(reader, section::kGlossNoise, num_gloss, num_rows, ScalarType::f16);
    return still_mesh;
}

BakedPose BakeReader::read_pose(uint32_t p) const {
    if (whole_ != nullptr) return read_gloss_pose(p);
    const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
    const auto read = [&](Tag tag, uint32_t num_planes, ScalarType type = ScalarType::f32) {
        return read_planes(reader, tag, num_planes, identity_.num_vertices, type);
    };
    BakedPose pose;
    pose.statistics = read_statistics_of(reader, identity_checksum_, p, identity_);
    pose.positions = read(section::kPositions, 3);
    pose.normals = read(section::kNormals, 3);
    pose.transfer = read(section::kTransfer, identity_.layout.num_planes());
    pose.noise = read(section::kNoise, identity_.layout.num_planes(), ScalarType::f16);
    if (gloss_rows_.empty()) return pose;
    const uint32_t num_planes = identity_.gloss->layout.num_planes();
    const auto num_rows = static_cast<uint32_t>(gloss_rows_.size());
    pose.gloss = read_planes(reader, section::kGloss, num_planes, num_rows);
    pose.gloss_noise =
        read_planes(reader, section::kGlossNoise, num_planes, num_rows, ScalarType::f16);
    return pose;
}

PoseStatistics BakeReader::read_statistics(uint32_t p) const {
    if (whole_ != nullptr) return whole_->read_statistics(p).of_gloss();
    return read_bake_statistics(directory_, identity_checksum_, p, identity_);
}

PoseStatistics BakeReader::total_statistics() const {
    std::vector<PoseStatistics> poses(num_poses());
    for (uint32_t p = 0; p < num_poses(); ++p) poses[p] = read_statistics(p);
    return combine(poses);
}

void BakeReader::verify_all() const {
    if (whole_ != nullptr) return whole_->verify_all();
    parallel_for(num_poses(), 1, [&](size_t index, size_t) {
        const auto p = static_cast<uint32_t>(index);
        const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
        const auto verify = [&](Tag tag, uint32_t num_planes, size_t num_points,
                                ScalarType type = ScalarType::f32) {
            verify_planes(reader, require_planes(reader, tag, num_planes,
                                                 static_cast<uint32_t>(num_points), type));
        };
        const uint32_t num_planes = identity_.layout.num_planes();
        read_statistics_of(reader, identity_checksum_, p, identity_);
        verify(section::kPositions, 3, identity_.num_vertices);
        verify(section::kNormals, 3, identity_.num_vertices);
        verify(section::kTransfer, num_planes, identity_.num_vertices);
        verify(section::kNoise, num_planes, identity_.num_vertices, ScalarType::f16);
        if (gloss_rows_.empty()) return;
        const uint32_t num_gloss = identity_.gloss->layout.num_planes();
        verify(section::kGloss, num_gloss, gloss_rows_.size());
        verify(section::kGlossNoise, num_gloss, gloss_rows_.size(), ScalarType::f16);
    });
}

void BakeReader::read_rows(uint32_t p, Tag tag, uint32_t num_planes, uint64_t first, uint64_t count,
                           float* out, ScalarType type) const {
    const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
    reader.read_range(require_planes(reader, tag, num_planes, identity_.num_vertices, type), first,
                      count, out);
}

void BakeReader::read_position_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    read_vector_rows(p, section::kPositions, first, count, out);
}

void BakeReader::read_normal_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    read_vector_rows(p, section::kNormals, first, count, out);
}

void BakeReader::read_vector_rows(uint32_t p, Tag tag, uint64_t first, uint64_t count,
                                  float* out) const {
    if (whole_ == nullptr) return read_rows(p, tag, 3, first, count, out);
    const std::vector<uint32_t>& rows = whole_->gloss_rows_;
    const uint64_t num_vertices = whole_->identity_.num_vertices;
    if (rows.size() == num_vertices) return whole_->read_vector_rows(p, tag, first, count, out);
    std::vector<float> plane(num_vertices);
    for (uint64_t done = 0; done < count;) {
        const uint64_t axis = (first + done) / rows.size();
        const uint64_t begin = (first + done) % rows.size();
        const uint64_t end = std::min<uint64_t>(rows.size(), begin + count - done);
        whole_->read_vector_rows(p, tag, axis * num_vertices, num_vertices, plane.data());
        for (uint64_t r = begin; r < end; ++r) *out++ = plane[rows[r]];
        done += end - begin;
    }
}

void BakeReader::read_transfer_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    read_rows(p, whole_ == nullptr ? section::kTransfer : section::kGloss,
              identity_.layout.num_planes(), first, count, out);
}

void BakeReader::read_noise_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    read_rows(p, whole_ == nullptr ? section::kNoise : section::kGlossNoise,
              identity_.layout.num_planes(), first, count, out, ScalarType::f16);
}

}  // namespace paim
