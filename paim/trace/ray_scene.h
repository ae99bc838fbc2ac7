// Intersects rays with the triangles of one pose. Only paim/trace uses Embree.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "paim/base/vector.h"
#include "paim/mesh/topology.h"

namespace paim {

// The triangle of a ray without a hit.
constexpr uint32_t kNoTriangle = std::numeric_limits<uint32_t>::max();

struct Hit {
    float distance;     // along the (unit) direction, scene units
    uint32_t triangle;  // index into the topology's triangles
    float u, v;         // barycentric weights of the triangle's second and third vertex
};

// An acceleration structure over one pose. Built on construction; all queries are thread-safe. Both
// sides of a triangle can be hit; triangles without area (mesh/normals.h) cannot. Results do not
// depend on the number of threads: traversal is Embree's conservative ("robust") one, so that only
// the triangle tests decide about hits.
class RayScene {
  public:
    // positions  [V] finite
    // Errors (unsupported): Embree cannot be started, or reports an error.
    RayScene(const Topology& topology, std::span<const Vec3f> positions);

    // The same with a second mesh. Its triangles are numbered after those of the first.
    RayScene(const Topology& topology, std::span<const Vec3f> positions, const Topology& still_mesh,
             std::span<const Vec3f> still_positions);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    // Whether anything lies in each direction from the origin, at any distance > 0.
    // x, y, z  [count] unit directions
    // occluded  [count] 1 or 0
    // returns  number of occluded directions
    // note     sixteen rays are traced together, which is fastest if their directions are similar
    uint32_t occluded(const Vec3f& origin, const float* x, const float* y, const float* z,
                      uint32_t count, float* occluded) const;

    // The nearest hit in each of the directions. The triangle of a ray without a hit is
    // kNoTriangle.
    // hits  [count]
    void intersect(const Vec3f& origin, const float* x, const float* y, const float* z,
                   uint32_t count, Hit* hits) const;

    // The nearest hit at distance > 0, if any.
    // ignored  numbers of triangles that the ray passes through, in ascending order
    std::optional<Hit> intersect_first(const Vec3f& origin, const Vec3f& direction,
                                       std::span<const uint32_t> ignored = {}) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace paim
