// Normals of decoded poses.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/rebuild_planes.h"

namespace paim::player {

// Computes normals as the bake does (paim/mesh/normals.h), but from positions within limits. It keeps
// what belongs to the mesh: faces without duplicates, and seams.
class PoseNormals {
  public:
    // Keeps a reference to the mesh.
    explicit PoseNormals(const CodedMesh& mesh);
    explicit PoseNormals(CodedMesh&&) = delete;

    // time     in poses, clamped to 0 … P−1
    // returns  [V] unit, in the axes of the scene; zero where a vertex has no face of any area
    std::vector<Vec3f> at(double time, uint32_t num_geometry_components);

  private:
    std::vector<Vec3f> positions(double time, uint32_t num_geometry_components);
    std::vector<uint32_t> seams();

    const CodedMesh& mesh_;
    Topology topology_;
    PositionDecoder decoder_;
    std::vector<float> planes_;    // [3][V] of the last pose
    std::vector<uint32_t> seams_;  // [V], or empty
};

}  // namespace paim::player
