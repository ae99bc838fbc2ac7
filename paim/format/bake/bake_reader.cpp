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
                                  uint32_t p, uint32_t bands) {
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
    statistics.transfer_rms = metadata.numbers("transfer_rms", bands, 0.0, kMax);
    statistics.noise_rms = metadata.numbers("noise_rms", bands, 0.0, kMax);
    statistics.mesh.zero_area_faces = metadata.count("zero_area_faces");
    statistics.mesh.coincident_faces = metadata.count("coincident_faces");
    return statistics;
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
    texture_ = read_texture(mesh, topology_, section::kTexture[0]);
    if (mesh_checksum(topology_, albedo_, texture_) != identity_.mesh_xxh3) {
        throw_bad_input("{}: not the mesh that the manifest names", mesh.name());
    }
    check_floor(topology_, identity_.num_following, mesh.name());
    if (!identity_.still_meshes.empty()) {
        still_mesh_ = read_bake_still_mesh(directory_, identity_checksum_, identity_.layout);
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
    read_statistics_of(pose, identity_checksum_, 0, identity_.layout.in_bands);
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

BakedPose BakeReader::read_pose(uint32_t p) const {
    const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
    const auto read = [&](Tag tag, uint32_t num_planes, ScalarType type = ScalarType::f32) {
        return read_planes(reader, tag, num_planes, identity_.num_vertices, type);
    };
    BakedPose pose;
    pose.statistics = read_statistics_of(reader, identity_checksum_, p, identity_.layout.in_bands);
    pose.positions = read(section::kPositions, 3);
    pose.normals = read(section::kNormals, 3);
    pose.transfer = read(section::kTransfer, identity_.layout.num_planes());
    pose.noise = read(section::kNoise, identity_.layout.num_planes(), ScalarType::f16);
    return pose;
}

PoseStatistics read_bake_statistics(const std::filesystem::path& directory,
                                    uint64_t identity_checksum, uint32_t p, uint32_t bands) {
    const ContainerReader reader(bake_pose_file(directory, p), section::kKindPose);
    return read_statistics_of(reader, identity_checksum, p, bands);
}

BakedStillMesh read_bake_still_mesh(const std::filesystem::path& directory,
                                    uint64_t identity_checksum, const TransferLayout& layout) {
    const ContainerReader reader(bake_still_mesh_file(directory), section::kKindMesh);
    BakedStillMesh still_mesh;
    still_mesh.pose.statistics =
        read_statistics_of(reader, identity_checksum, kStillMeshPose, layout.in_bands);
    const uint32_t num_vertices = count_vertices(reader, section::kPositions);
    still_mesh.pose.positions = read_planes(reader, section::kPositions, 3, num_vertices);
    still_mesh.pose.normals = read_planes(reader, section::kNormals, 3, num_vertices);
    still_mesh.pose.transfer =
        read_planes(reader, section::kTransfer, layout.num_planes(), num_vertices);
    still_mesh.pose.noise =
        read_planes(reader, section::kNoise, layout.num_planes(), num_vertices, ScalarType::f16);
    still_mesh.topology = read_triangles(reader, num_vertices);
    still_mesh.albedo = read_albedo(reader, num_vertices);
    still_mesh.texture = read_texture(reader, still_mesh.topology, section::kTexture[0]);
    return still_mesh;
}

PoseStatistics BakeReader::total_statistics() const {
    std::vector<PoseStatistics> poses(num_poses());
    for (uint32_t p = 0; p < num_poses(); ++p) poses[p] = read_statistics(p);
    return combine(poses);
}

void BakeReader::verify_all() const {
    parallel_for(num_poses(), 1, [&](size_t index, size_t) {
        const auto p = static_cast<uint32_t>(index);
        const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
        const auto verify = [&](Tag tag, uint32_t num_planes, ScalarType type = ScalarType::f32) {
            verify_planes(reader,
                          require_planes(reader, tag, num_planes, identity_.num_vertices, type));
        };
        read_statistics_of(reader, identity_checksum_, p, identity_.layout.in_bands);
        verify(section::kPositions, 3);
        verify(section::kNormals, 3);
        verify(section::kTransfer, identity_.layout.num_planes());
        verify(section::kNoise, identity_.layout.num_planes(), ScalarType::f16);
    });
}

void BakeReader::read_position_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
    reader.read_range(require_planes(reader, section::kPositions, 3, identity_.num_vertices), first,
                      count, out);
}

void BakeReader::read_transfer_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
    reader.read_range(require_planes(reader, section::kTransfer, identity_.layout.num_planes(),
                                     identity_.num_vertices),
                      first, count, out);
}

void BakeReader::read_noise_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const {
    const ContainerReader reader(bake_pose_file(directory_, p), section::kKindPose);
    reader.read_range(require_planes(reader, section::kNoise, identity_.layout.num_planes(),
                                     identity_.num_vertices, ScalarType::f16),
                      first, count, out);
}

}  // namespace paim
