// A compressed animation in memory: what a .paim file holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "paim/base/check.h"
#include "paim/codec/low_rank.h"
#include "paim/codec/transfer_model.h"
#include "paim/mesh/topology.h"
#include "paim/transfer/layout.h"

namespace paim {

// The most poses that a file may hold: twelve hours at 24 frames a second.
constexpr uint32_t kMaxPoses = 1u << 20;

// What vertices have: each attribute is compressed on its own.
enum class Attribute { geometry, transfer };

// One lit thing: a character, the floor under it, or what stands still around it.
struct CodedMesh {
    Topology topology;
    Albedo albedo;
    TransferLayout layout;
    LowRank positions;       // 3 planes: x, y, z, scene units; a point is a vertex
    CodedTransfer transfer;  // of layout.num_planes() planes

    // 1 if it stands still under still light. Attributes that have one pose only keep it for ever.
    uint32_t num_poses() const {
        return std::max(positions.num_poses, transfer.empty() ? 0u : transfer->matrix.num_poses);
    }
    const LowRank& attribute(Attribute which) const {
        return which == Attribute::geometry ? positions : transfer->matrix;
    }
};

// Whose order vertices and triangles have.
enum class VertexOrder : uint32_t {
    baked = 0,  // the bake's
    cache = 1,  // what cache_order() makes of it (mesh/cache_order.h)
};

struct Asset {
    // The first part moves. Others may stand still: they were baked without the first part, so that
    // it casts no shadow on them, but they block and bounce its light.
    std::vector<CodedMesh> parts = std::vector<CodedMesh>(1);
    // What positions are counted from, scene units: adding it, in double, gives scene coordinates.
    // Zero unless the mesh was far from the world's origin; who shows one asset alone may ignore it.
    Vec3d origin = Vec3d::Zero();
    float frames_per_second = 24.0f;
    VertexOrder vertex_order = VertexOrder::baked;  // of every part
    bool complete = true;  // false: the file has more components, which were not there yet
    std::string name;
    std::string provenance_json;  // a JSON object: how it was made, for people and paim-info

    const CodedMesh& moving() const { return parts.front(); }
    CodedMesh& moving() { return parts.front(); }
    // What stands still; nullptr if nothing does. A file holds one such part at most.
    const CodedMesh* still() const { return parts.size() > 1 ? &parts[1] : nullptr; }
    CodedMesh* still() { return parts.size() > 1 ? &parts[1] : nullptr; }
    uint32_t num_poses() const { return moving().num_poses(); }
};

}  // namespace paim
