// Still meshes among the poses, which block their light and bounce it.
#pragma once

#include <string>
#include <vector>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/pose_source.h"

namespace paim {

// All still meshes as one.
struct StillMesh {
    Topology topology;
    Albedo albedo;
    Materials materials;
    Texture texture;
    Pose pose;
    std::vector<BakeIdentity::Source> sources;  // names and checksums of the meshes that were added

    bool empty() const { return topology.num_vertices == 0; }

    // Adds the source's first pose, whose positions are relative to the origin of the poses.
    // Error (bad input) if that makes more than 2^31 - 1 vertices, or a texture that is too large.
    void add(const PoseSource& source);
};

}  // namespace paim
