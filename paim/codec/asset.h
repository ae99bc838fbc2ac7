// A compressed animation in memory: the contents of a .paim file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/codec/low_rank.h"
#include "paim/codec/transfer_model.h"
#include "paim/mesh/root_motion.h"
#include "paim/mesh/texture.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// The largest number of poses of a file: twelve hours at 24 frames a second.
constexpr uint32_t kMaxPoses = 1u << 20;

// Attributes of vertices. Each is compressed on its own.
enum class Attribute { geometry, transfer, gloss };
constexpr size_t kNumAttributes = 3;

// Radiance that leaves glossy vertices, in addition to the diffuse one. It depends on the direction
// towards the eye: Σ_o e_o y_o(direction), with e_o = tint · Σ_i t_oi L_i for each vertex. Light is in
// local axes, and directions are in the frame of the vertex (codec/gloss_frames.h).
struct CodedGloss {
    TransferLayout layout;  // of kind glossy
    uint32_t num_rows = 0;
    CodedTransfer transfer;          // of layout.num_planes() planes, [R] rows as its vertices
    std::vector<uint32_t> vertices;  // [R] the vertex of each row; empty: row r is vertex r
    Albedo tint;                     // [1] or [R]
    // 3 planes: how the frame of each row is turned against that which positions tell, as a rotation
    // vector in radians. Without points if none is. Normals of files, and those across seams, are not
    // those of the positions.
    LowRank frame_turns;

    uint32_t vertex(uint32_t row) const { return vertices.empty() ? row : vertices[row]; }
};

// One lit mesh: the moving part (with its floor), or the still part around it.
struct CodedMesh {
    Topology topology;
    Albedo albedo;
    TransferLayout layout;
    LowRank positions;                // 3 planes: local x, y, z, scene units; a point is a vertex
    CodedTransfer transfer;           // of layout.num_planes() planes, in local axes
    std::optional<CodedGloss> gloss;  // of the glossy vertices, if there are any
    LowRank frame_turns;              // of transfer that is glossy itself: CodedGloss::frame_turns
    Texture texture;         // its colours take the place of the albedo where a face has an image
    RootMotion root_motion;  // from local coordinates to the scene, [P] or empty
    // How many vertices, from the first, follow the root motion. The others are a floor, which keeps
    // its place, or have no face. Triangles of the floor come after all others.
    uint32_t num_following = kAllVertices;

    // 1 for a still part. An attribute with a single pose has the same values at all times.
    uint32_t num_poses() const {
        return std::max(positions.num_poses, transfer.empty() ? 0u : transfer->matrix.num_poses);
    }
    // Bands of light that the transfer or the gloss responds to.
    uint32_t light_bands() const {
        return std::max(layout.in_bands, gloss ? gloss->layout.in_bands : 0u);
    }
    bool has(Attribute which) const { return which != Attribute::gloss || gloss.has_value(); }
    // The attributes that it has, in the order of their numbers.
    std::vector<Attribute> attributes() const {
        std::vector<Attribute> all{Attribute::geometry, Attribute::transfer};
        if (gloss) all.push_back(Attribute::gloss);
        return all;
    }
    const LowRank& attribute(Attribute which) const {
        switch (which) {
            case Attribute::geometry:
                return positions;
            case Attribute::transfer:
                return transfer->matrix;
            case Attribute::gloss:
                break;
        }
        PAIM_CHECK(gloss.has_value());
        return gloss->transfer->matrix;
    }
    LowRank& attribute(Attribute which) {
        return const_cast<LowRank&>(std::as_const(*this).attribute(which));
    }
};

// The order of vertices and triangles.
enum class VertexOrder : uint32_t {
    baked = 0,  // that of the bake
    cache = 1,  // that of cache_order() (mesh/cache_order.h)
};

struct Asset {
    // The first part moves. Others are still: they were baked without the first part, so that it
    // casts no shadow on them, but they block and bounce its light.
    std::vector<CodedMesh> parts = std::vector<CodedMesh>(1);
    // Origin of all positions, scene units: adding it, in double, gives scene coordinates. Zero
    // unless the mesh was far from the world's origin. A program that shows a single asset may
    // ignore it.
    Vec3d origin = Vec3d::Zero();
    float frames_per_second = 24.0f;
    VertexOrder vertex_order = VertexOrder::baked;  // of every part
    bool complete = true;  // false: read from a prefix, without all components of the file
    std::string name;
    std::string provenance_json;  // a JSON object: how the file was made, shown by paim-info

    const CodedMesh& moving() const { return parts.front(); }
    CodedMesh& moving() { return parts.front(); }
    // The still part, or nullptr. A file holds at most one.
    const CodedMesh* still() const { return parts.size() > 1 ? &parts[1] : nullptr; }
    CodedMesh* still() { return parts.size() > 1 ? &parts[1] : nullptr; }
    uint32_t num_poses() const { return moving().num_poses(); }
};

}  // namespace paim
