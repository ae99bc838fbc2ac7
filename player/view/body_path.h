// The way of the body through the scene, smooth enough for a camera to follow.
#pragma once

#include <optional>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/rebuild_planes.h"

namespace paim::player {

class BodyPath {
  public:
    // Keeps a reference to the asset.
    explicit BodyPath(const Asset& asset);

    // Where the middle of the body is at `time` (in poses, clamped to 0 … P−1): of the bounding box of
    // its vertices without a floor, averaged over half a second, so that swinging arms do not shake
    // the camera. Poses are decoded at first use.
    Vec3d at(double time);

  private:
    const Vec3d& middle_of(size_t pose);
    Vec3d smooth_at(size_t pose);

    const CodedMesh& mesh_;
    size_t reach_;  // poses on either side that the average takes in
    std::vector<uint32_t> vertices_;
    std::vector<std::optional<Vec3d>> middles_, smooth_;  // [P] empty: not computed yet
    PositionDecoder decoder_;
    std::vector<float> planes_;
};

// Vertices that make up the body of a mesh: those of faces, without a floor.
std::vector<uint32_t> body_vertices(const CodedMesh& mesh);

}  // namespace paim::player
