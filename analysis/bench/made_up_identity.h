// The identity of a bake whose numbers were made up: of two rays, with everything as it is by
// default.
#pragma once

#include <utility>
#include <vector>

#include "paim/format/bake/bake_directory.h"

namespace paim {

// poses  names and numbers
inline BakeIdentity made_up_identity(const Topology& topology, const Albedo& albedo,
                                     const TransferLayout& layout,
                                     std::vector<BakeIdentity::Source> poses) {
    BakeIdentity identity;
    identity.layout = layout;
    identity.rays = 2;
    identity.sampler = "cosine";
    identity.streams = "per-pose";
    identity.normals = "faces";
    identity.num_vertices = topology.num_vertices;
    identity.num_triangles = static_cast<uint32_t>(topology.triangles.size());
    identity.mesh_xxh3 = mesh_checksum(topology, albedo);
    identity.poses = std::move(poses);
    return identity;
}

}  // namespace paim
