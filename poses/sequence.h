// A procedural pose sequence: one topology, and positions made for any pose when asked.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/pose_set.h"
#include "paim/mesh/topology.h"

namespace paim::poses {

class Sequence {
  public:
    virtual ~Sequence() = default;

    virtual const Topology& topology() const = 0;

    // One value, or one per vertex where the sequence is coloured.
    virtual const Albedo& albedo() const = 0;

    // Positions [V] of pose p of num_poses, scene units, Y up. Sequences loop: pose num_poses would
    // equal pose 0. May be called from several threads at once.
    virtual std::vector<Vec3f> positions(uint32_t p, uint32_t num_poses) const = 0;
};

// All poses in memory; meant for small sequences.
inline PoseSet make_pose_set(const Sequence& sequence, uint32_t num_poses) {
    std::vector<std::vector<Vec3f>> positions;
    positions.reserve(num_poses);
    for (uint32_t p = 0; p < num_poses; ++p) positions.push_back(sequence.positions(p, num_poses));
    return {sequence.topology(), std::move(positions), sequence.albedo()};
}

}  // namespace paim::poses
