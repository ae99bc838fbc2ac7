// Scenery: meshes that stand still among the poses.
#pragma once

#include <string>
#include <vector>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/pose_source.h"

namespace paim {

// Several still meshes as one.
struct StaticMesh {
    Topology topology;
    Albedo albedo;
    Pose pose;
    std::vector<BakeIdentity::Source> sources;  // names and checksums of what was added

    bool empty() const { return topology.num_vertices == 0; }

    // Adds the source's first pose, counted from the same origin as the poses it stands among.
    // Error (bad input) if that makes more than 2^31 - 1 vertices.
    void add(const PoseSource& source);
};

}  // namespace paim
