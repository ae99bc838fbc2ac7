// The .bake directory: manifest.json, mesh.bin and one self-contained, checksummed file a pose.
// Layout: docs/format.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "paim/format/bake/pose_statistics.h"
#include "paim/format/container/container_reader.h"
#include "paim/mesh/pose_source.h"
#include "paim/mesh/root_motion.h"
#include "paim/transfer/layout.h"

namespace paim {

// How often light may bounce.
constexpr uint32_t kMaxBounces = 16;

// The glossy transfer of a bake.
struct GlossIdentity {
    TransferLayout layout;                 // of kind glossy
    std::vector<GlossMaterial> materials;  // of all meshes (Materials::glossy)
    bool operator==(const GlossIdentity&) const = default;
};

// Everything that decides the bytes of a bake. Bakes with the same identity may share a directory.
struct BakeIdentity {
    uint32_t baker = 0;  // version of the baker, raised whenever its results change
    TransferLayout layout;
    uint32_t rays = 0;  // per vertex; with a transfer_error, the largest number
    uint64_t seed = 0;
    double transfer_error = 0.0;  // noise target of every vertex; 0: a fixed count of rays
    std::string sampler;          // "cosine", "uniform" or "uniform-sobol"
    std::string streams;          // "per-pose", "shared" or "mixed"
    std::string normals;          // "faces" or "file"
    uint32_t bounces = 0;         // number of times that light bounces, 0 … kMaxBounces
    std::string floor;            // description of the ground under the poses; empty if none
    uint32_t num_vertices = 0;
    uint32_t num_triangles = 0;
    uint64_t mesh_xxh3 = 0;        // of triangles, albedo and texture
    Vec3d origin = Vec3d::Zero();  // origin of the scene's coordinates, scene units
    RootMotion root_motion;        // [P] or empty: poses are in local coordinates
    // How many vertices, from the first, follow the root motion. The others are a floor.
    uint32_t num_following = kAllVertices;
    struct Source {
        std::string name;
        uint64_t xxh3 = 0;
        bool operator==(const Source&) const = default;
    };
    std::vector<Source> poses;           // [P]
    std::vector<Source> still_meshes;    // checksums of all bytes that were read for them
    std::optional<GlossIdentity> gloss;  // if any vertex is glossy

    uint32_t num_poses() const { return static_cast<uint32_t>(poses.size()); }
    bool operator==(const BakeIdentity&) const = default;
};

// Checksum of what all poses share: the triangles, the albedo, the texture, and the materials if any is
// glossy.
uint64_t mesh_checksum(const Topology& topology, const Albedo& albedo, const Texture& texture = {},
                       const Materials& materials = {});

// One baked pose, in its local coordinates and axes where the bake has a root motion. Planes as in
// transfer/layout.h.
struct BakedPose {
    std::vector<float> positions;  // [3][V] scene units
    std::vector<float> normals;    // [3][V]
    std::vector<float> transfer;   // [planes][V]
    // [planes][V] the scaled difference of the two estimates whose mean is the transfer. It is one
    // draw with the mean (0) and the variance of the transfer's error, and uncorrelated with it
    // (docs/algorithms/transfer.md). Files hold it as f16.
    std::vector<float> noise;
    PoseStatistics statistics;
    // The same of the glossy transfer, [planes of GlossIdentity::layout][R] (mesh/materials.h:
    // glossy_rows()), with its outgoing side in frames (baked_frames.h). Empty if the bake has none.
    std::vector<float> gloss;
    std::vector<float> gloss_noise;
};

// Memory of the arrays of a baked pose.
inline uint64_t baked_pose_bytes(uint64_t num_vertices, const TransferLayout& layout) {
    return (6 + 2 * uint64_t{layout.num_planes()}) * num_vertices * sizeof(float);
}

// Size of the file of a pose, but for its header and statistics.
inline uint64_t pose_file_bytes(uint64_t num_vertices, const TransferLayout& layout) {
    const uint64_t planes = layout.num_planes();
    return num_vertices * (6 * sizeof(float) + planes * (sizeof(float) + sizeof(uint16_t)));
}

// The pose number of the still meshes in random streams and in metadata.
constexpr uint32_t kStillMeshPose = std::numeric_limits<uint32_t>::max();

// The still meshes among the poses as one mesh, baked once, without the poses.
struct BakedStillMesh {
    Topology topology;
    Albedo albedo;
    BakedPose pose;
    Materials materials = {};
    Texture texture = {};
};

// Reads the statistics of pose p. Errors (bad input) name the file: damaged, of another pose, or of
// another bake than that with this identity, whose checksum is given (bake_manifest.h).
PoseStatistics read_bake_statistics(const std::filesystem::path& directory,
                                    uint64_t identity_checksum, uint32_t p,
                                    const BakeIdentity& identity);

// Reads the still meshes of a bake. Errors (bad input) name the file: missing, damaged, of another
// bake, or with invalid shapes, indices or numbers.
BakedStillMesh read_bake_still_mesh(const std::filesystem::path& directory,
                                    uint64_t identity_checksum, const BakeIdentity& identity);

// Writes a bake, or resumes one.
class BakeWriter {
  public:
    // Creates the directory, or resumes the bake in it.
    // materials  whose glossy ones identity.gloss lists (checked)
    // Errors: bad input if it holds a bake of
    // another identity (the first difference is named) or other files; output failed.
    BakeWriter(std::filesystem::path directory, const BakeIdentity& identity,
               const Topology& topology, const Albedo& albedo, const Texture& texture = {},
               const Materials& materials = {});

    // Whether the bake has the whole pose p, of this identity.
    bool has_pose(uint32_t p) const;

    // The statistics of a pose that has been baked.
    PoseStatistics read_statistics(uint32_t p) const {
        return read_bake_statistics(directory_, identity_checksum_, p, identity_);
    }

    // Writes the file of a pose completely or not at all. May be called from several threads.
    void write_pose(uint32_t p, const BakedPose& pose) const;

    // The same for the still meshes of a bake whose identity names some.
    bool has_still_mesh() const;
    void write_still_mesh(const BakedStillMesh& still_mesh) const;

  private:
    std::filesystem::path directory_;
    BakeIdentity identity_;
    uint64_t identity_checksum_;
    uint32_t num_gloss_rows_ = 0;
};

// Whether the directory is there and is a bake, complete or not.
bool is_bake(const std::filesystem::path& directory);

// Reads a complete bake.
class BakeReader {
  public:
    // Errors (bad input) name the file: not a bake, damaged, poses missing.
    explicit BakeReader(std::filesystem::path directory);

    const std::filesystem::path& directory() const { return directory_; }
    const BakeIdentity& identity() const { return identity_; }
    const Topology& topology() const { return topology_; }
    const Albedo& albedo() const { return albedo_; }
    const Materials& materials() const { return materials_; }
    const Texture& texture() const { return texture_; }
    uint32_t num_poses() const { return identity_.num_poses(); }

    // The still meshes; nothing if the bake has none.
    const std::optional<BakedStillMesh>& still_mesh() const { return still_mesh_; }

    // The vertices of the poses that have glossy transfer, ascending (mesh/materials.h).
    const std::vector<uint32_t>& gloss_rows() const { return gloss_rows_; }
    // This bake as one of the glossy transfer alone, which code of the transfer can work on: rows are
    // its vertices, the faces among them its triangles, the tints its albedo, and its transfer is the
    // glossy one. Its still mesh is that of the glossy rows of the still meshes.
    // Error (unsupported) if the poses have no glossy vertex.
    BakeReader gloss() const;

    // Reads every byte of pose p and checks it. May be called from several threads.
    BakedPose read_pose(uint32_t p) const;
    PoseStatistics read_statistics(uint32_t p) const;

    // Size of all files of the bake.
    uint64_t size_bytes() const;

    // Statistics of all poses together.
    PoseStatistics total_statistics() const;

    // Checks the checksums of all poses. Call it once before rows are read.
    void verify_all() const;

    // Rows [first, first + count) of positions or normals (3 · V rows), transfer or noise (planes · V
    // rows) of pose p.
    void read_position_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;
    void read_normal_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;
    void read_transfer_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;
    void read_noise_rows(uint32_t p, uint64_t first, uint64_t count, float* out) const;

  private:
    BakedPose read_gloss_pose(uint32_t p) const;
    // Of positions or normals.
    void read_vector_rows(uint32_t p, Tag tag, uint64_t first, uint64_t count, float* out) const;
    void read_rows(uint32_t p, Tag tag, uint32_t num_planes, uint64_t first, uint64_t count,
                   float* out, ScalarType type = ScalarType::f32) const;

    std::filesystem::path directory_;
    BakeIdentity identity_;
    uint64_t identity_checksum_;
    Topology topology_;
    Albedo albedo_;
    Materials materials_;
    Texture texture_;
    std::optional<BakedStillMesh> still_mesh_;
    std::vector<uint32_t> gloss_rows_;
    // Of a bake of the glossy transfer alone: the whole bake.
    std::shared_ptr<const BakeReader> whole_;
};

std::filesystem::path bake_pose_file(const std::filesystem::path& directory, uint32_t p);
std::filesystem::path bake_still_mesh_file(const std::filesystem::path& directory);

}  // namespace paim
