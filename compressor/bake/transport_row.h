// Rows of the transport matrix: the vertices that the rays of a vertex hit, with their weights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/surface_hits.h"

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
        : hits_(scene, topology, positions) {}

    // Adds a round of rays of one half of a vertex to the row, each with a weight (SurfaceHits).
    void trace(uint32_t vertex, const RayStart& start, const Vec3f& normal,
               const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half,
               double weight = 1.0);

    void end(TransportRow& row);

    // Rays of the row that hit a triangle from behind.
    uint32_t num_back_hits() const { return hits_.num_back_hits(); }

  private:
    SurfaceHits hits_;
    std::vector<HitWeight> shares_;  // of the row, in the order of the rays
    double num_points_ = 0.0;        // times their weights
};

}  // namespace paim
