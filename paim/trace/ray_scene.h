// Rays against the triangles of one pose. The one room that knows Embree.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>

#include "paim/base/vector.h"
#include "paim/mesh/topology.h"

namespace paim {

// In a hit: nothing.
constexpr uint32_t kNoTriangle = std::numeric_limits<uint32_t>::max();

struct Hit {
    float distance;     // along the (unit) direction, scene units
    uint32_t triangle;  // index into the topology's triangles
    float u, v;         // barycentric weights of the triangle's second and third vertex
};

// An acceleration structure over one pose. Built on construction; all queries are thread-safe. Both
// sides of a triangle are hit, triangles without area (mesh/normals.h) never. Answers do not depend
// on the number of threads: traversal is Embree's conservative ("robust") one, so that it is the
// triangle tests alone that decide.
class RayScene {
  public:
    // positions [V] finite. Throws Error(unsupported) if Embree cannot be started, or what it
    // reports.
    RayScene(const Topology& topology, std::span<const Vec3f> positions);

    // The same with a second mesh. Its triangles are counted on from the first one's.
    RayScene(const Topology& topology, std::span<const Vec3f> positions, const Topology& still_mesh,
             std::span<const Vec3f> still_positions);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    // Whether anything lies in each direction from the origin, at any distance > 0.
    // x, y, z  [count] unit directions
    // occluded  [count] 1 or 0
    // note     sixteen at a time: fastest if neighbouring directions follow one another
    // returns  how many are occluded
    uint32_t occluded(const Vec3f& origin, const float* x, const float* y, const float* z,
                      uint32_t count, float* occluded) const;

    // The nearest hit in each of these directions; its triangle is kNoTriangle where there is none.
    // hits  [count]
    void intersect(const Vec3f& origin, const float* x, const float* y, const float* z,
                   uint32_t count, Hit* hits) const;

    // The nearest hit at distance > 0, if any.
    std::optional<Hit> intersect_first(const Vec3f& origin, const Vec3f& direction) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace paim
