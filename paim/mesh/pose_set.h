// A pose sequence held in memory, for small sequences made by code.
#pragma once

#include <string>
#include <vector>

#include "paim/mesh/pose_source.h"

namespace paim {

class PoseSet : public PoseSource {
  public:
    // Vertex normals are computed from the faces (mesh/normals.h) and shared across seams
    // (mesh/seams.h).
    // positions  [P][V], at least one pose, each with topology.num_vertices entries
    PoseSet(Topology topology, std::vector<std::vector<Vec3f>> positions, Albedo albedo = {});

    const Topology& topology() const override { return topology_; }
    const Albedo& albedo() const override { return albedo_; }
    uint32_t num_poses() const override { return static_cast<uint32_t>(positions_.size()); }
    std::string pose_name(uint32_t p) const override;
    uint64_t pose_checksum(uint32_t p) const override;
    Pose load_pose(uint32_t p) const override;

  private:
    void find_seams();

    Topology topology_;
    Topology distinct_;            // without duplicate faces, for the normals
    std::vector<uint32_t> seams_;  // vertices that share normals (mesh/seams.h)
    std::vector<std::vector<Vec3f>> positions_;
    Albedo albedo_;
};

}  // namespace paim
