// Rows of the transport matrix: the vertices that the rays of a vertex hit, with their weights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/direction_sampler.h"
#include "compressor/bake/ray_start.h"
#include "paim/mesh/topology.h"
#include "paim/trace/ray_scene.h"

namespace paim {

struct HitWeight {
    uint32_t vertex;
    float weight;
};

// A row of the matrix that carries radiance from vertices to one vertex: Σ weight ·
// radiance(vertex) is the mean over its rays of the radiance at their hits, interpolated on the
// triangles. Sorted by vertex.
using TransportRow = std::vector<HitWeight>;

// Traces one row.
class HitTracer {
  public:
    // topology, positions  of all meshes of the scene, in its order
    // Keeps references to all arguments.
    HitTracer(const RayScene& scene, const Topology& topology, std::span<const Vec3f> positions)
        : scene_(scene), topology_(topology), positions_(positions) {}

    // Adds a round of rays of one half of a vertex to the row, each with a weight. A triangle that
    // is hit from behind blocks the ray and gives no light. A direction that the fan of the start
    // hides meets the faces round the vertex at the vertex itself.
    void trace(uint32_t vertex, const RayStart& start, const Vec3f& normal,
               const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half,
               double weight = 1.0);

    void end(TransportRow& row);

    // Rays of the row that hit a triangle from behind.
    uint32_t num_back_hits() const { return num_back_hits_; }

  private:
    Vec3d direction(size_t ray) const;
    void find_hits(const RayStart& start);
    void add_hit(const Hit& hit, size_t ray, float weight);

    const RayScene& scene_;
    const Topology& topology_;
    std::span<const Vec3f> positions_;
    RaySet rays_;
    std::vector<Hit> hits_;          // [rays]
    std::vector<HitWeight> shares_;  // of the row, in the order of the rays
    double num_points_ = 0.0;        // times their weights
    uint32_t num_back_hits_ = 0;
};

}  // namespace paim
