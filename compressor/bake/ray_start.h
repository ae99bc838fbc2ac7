// Where the rays of each vertex start.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "compressor/bake/ray_offset.h"
#include "compressor/bake/vertex_fan.h"
#include "paim/mesh/topology.h"
#include "paim/trace/ray_scene.h"

namespace paim {

// The start of the rays of one vertex.
struct RayStart {
    Vec3f origin;
    // If there is one, the origin is the vertex itself. The fan says which directions the faces
    // round the vertex hide, and rays pass through these faces.
    const VertexFan* fan = nullptr;
};

// The starts of one pose. Rays start off the surface:
//
// * along the vertex normal, by the distance of the rule, where all faces round the vertex lie
//   clearly below the normal's start;
// * otherwise along the direction that rises most above all of these faces, so far that the start
//   is above their rounding;
// * otherwise, if there is no such direction, or only far off, at the vertex itself.
//
// In the first two cases the start is above the plane of every face round the vertex, so that rays
// meet a face only where the vertex itself sees its front.
class RayStarts {
  public:
    // positions  [V] finite
    // normals    [V] unit or zero
    RayStarts(const Topology& topology, std::span<const Vec3f> positions,
              std::span<const Vec3f> normals, const RayOffsetRule& rule = {});

    // The start of a vertex with a normal.
    RayStart operator[](size_t v) const;

    // Vertices whose rays start at the vertex itself.
    size_t num_fans() const { return fans_.size(); }

  private:
    std::vector<Vec3f> origins_;                                               // [V]
    std::vector<std::pair<uint32_t, std::unique_ptr<const VertexFan>>> fans_;  // by vertex
};

// RayScene::occluded() from a start.
uint32_t occluded_from(const RayScene& scene, const RayStart& start, const float* x, const float* y,
                       const float* z, uint32_t count, float* occluded);

}  // namespace paim
