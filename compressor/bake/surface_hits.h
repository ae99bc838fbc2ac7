// Where the rays of a vertex meet the fronts of surfaces.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/direction_sampler.h"
#include "compressor/bake/ray_start.h"
#include "paim/mesh/topology.h"
#include "paim/trace/ray_scene.h"

namespace paim {

// Where a ray meets a surface: what is interpolated there is Σ weight · value over the corners.
struct SurfaceHit {
    uint32_t ray;  // among those of the round
    uint32_t num_corners;
    std::array<uint32_t, 3> vertices;
    std::array<float, 3> weights;
};

// Traces rays round by round.
class SurfaceHits {
  public:
    // topology, positions  of all meshes of the scene, in its order
    // Keeps references to all arguments.
    SurfaceHits(const RayScene& scene, const Topology& topology, std::span<const Vec3f> positions)
        : scene_(scene), topology_(topology), positions_(positions) {}

    // Traces a round of one half of a vertex. A triangle that is hit from behind blocks the ray and
    // is no hit. A direction that the fan of the start hides meets the faces round the vertex at the
    // vertex itself.
    void trace(uint32_t vertex, const RayStart& start, const Vec3f& normal,
               const DirectionSampler& sampler, const HalfKeys& keys, uint32_t half);

    // Of the last round, hits in the order of their rays.
    const RaySet& rays() const { return rays_; }
    const std::vector<SurfaceHit>& hits() const { return on_surface_; }

    // Rays of all rounds that hit a triangle from behind.
    uint32_t num_back_hits() const { return num_back_hits_; }

  private:
    Vec3d direction(size_t ray) const;
    void find_hits(const RayStart& start);
    void add_hit(const Hit& hit, uint32_t ray);

    const RayScene& scene_;
    const Topology& topology_;
    std::span<const Vec3f> positions_;
    RaySet rays_;
    std::vector<Hit> hits_;  // [rays]
    std::vector<SurfaceHit> on_surface_;
    uint32_t num_back_hits_ = 0;
};

}  // namespace paim
