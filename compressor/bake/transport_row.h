// Where the rays of a vertex end: the vertices whose light it sees, and how much each counts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/direction_sampler.h"
#include "paim/mesh/topology.h"
#include "paim/trace/ray_scene.h"

namespace paim {

struct HitWeight {
    uint32_t vertex;
    float weight;
};

// A row of the matrix that takes radiance from vertices to a vertex: Σ weight · radiance(vertex) is
// the mean over its rays of the radiance that they hit, interpolated on the triangles. Sorted by
// vertex.
using TransportRow = std::vector<HitWeight>;

// Traces one row.
class HitTracer {
  public:
    // topology, positions  of all that the scene holds, in its order; they and the scene stay
    HitTracer(const RayScene& scene, const Topology& topology, std::span<const Vec3f> positions)
        : scene_(scene), topology_(topology), positions_(positions) {}

    // Adds a batch of rays to the row. Triangles hit from behind take a ray's light away and give
    // none.
    void trace(const Vec3f& origin, const Vec3f& normal, const DirectionSampler& sampler,
               uint64_t key);

    void end(TransportRow& row);

    // Rays of the row that hit a triangle from behind.
    uint32_t num_back_hits() const { return num_back_hits_; }

  private:
    const RayScene& scene_;
    const Topology& topology_;
    std::span<const Vec3f> positions_;
    RaySet rays_;
    std::vector<Hit> hits_;          // [rays]
    std::vector<HitWeight> shares_;  // of the row, in the order of the rays
    uint64_t num_points_ = 0;
    uint32_t num_back_hits_ = 0;
};

}  // namespace paim
