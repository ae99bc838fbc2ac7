// The rays of one pose and what is known of them.
#pragma once

#include <cstdint>
#include <vector>

#include "compressor/bake/neighbours.h"
#include "compressor/bake/ray_rounds.h"
#include "compressor/bake/ray_start.h"
#include "compressor/scene/still_mesh.h"
#include "paim/mesh/pose_source.h"
#include "paim/trace/ray_scene.h"

namespace paim {

struct PoseRays {
    // Keeps references to topology, pose and options.
    // still_mesh  among the pose; may be empty
    PoseRays(const Topology& own_topology, const Pose& own_pose, const StillMesh& still_mesh,
             const BakeOptions& options, uint32_t p)
        : topology(own_topology),
          pose(own_pose),
          scene(own_topology, own_pose.positions, still_mesh.topology, still_mesh.pose.positions),
          starts(own_topology, own_pose.positions, own_pose.normals),
          neighbours(own_topology),
          rounds(options, p, own_topology.num_vertices),
          num_rays(own_topology.num_vertices, 0),
          num_occluded(own_topology.num_vertices, 0),
          open_around(own_topology.num_vertices, 0.0) {}

    size_t num_vertices() const { return topology.num_vertices; }
    bool has_normal(size_t v) const { return !pose.normals[v].isZero(0.0f); }

    const Topology& topology;
    const Pose& pose;
    const RayScene scene;
    const RayStarts starts;
    const Neighbours neighbours;
    RayRounds rounds;
    std::vector<uint64_t> num_rays;      // [V] above the horizon and traced
    std::vector<uint64_t> num_occluded;  // [V] of these
    // [V] the factor c of an unoccluded vertex in its estimate (split_estimate.h)
    std::vector<double> open_around;
};

}  // namespace paim
