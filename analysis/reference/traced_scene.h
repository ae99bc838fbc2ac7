// Traced light on a mesh: what vertices, or any points of its triangles, reflect.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/reference/direct_light.h"
#include "analysis/reference/traced_mesh.h"
#include "compressor/bake/ray_start.h"
#include "paim/mesh/topology.h"
#include "paim/trace/ray_scene.h"

namespace paim {

// How light is traced.
struct TraceSettings {
    uint32_t bounces = 0;
    uint64_t seed = 1;
    uint32_t pose = 0;  // keys the random numbers
};

// Light that bounced b times and reaches the vertices, per half of the rays, times 1/π and without
// the vertices' own albedo: terms[b][half][v].
struct VertexLight {
    using Term = std::array<std::vector<Vec3f>, 2>;
    std::vector<Term> terms;

    // [V] the sum over all bounces of a half.
    std::vector<Vec3f> half(size_t half) const;
};

class TracedScene {
  public:
    // mesh   is lit
    // still  blocks its light and bounces it; its own light is known
    // Errors: those of RayScene.
    TracedScene(TracedMesh mesh, const TracedMesh& still);

    // light     whose number of rays a vertex has, and half as many more for each bounce
    // of_still  light on the still mesh with as many bounces; nullptr: there is none
    VertexLight light_vertices(const DirectLight& light, const TraceSettings& settings,
                               const VertexLight* of_still = nullptr) const;

    // What points of albedo 1 would reflect, whose normals are interpolated.
    // of_mesh  light_vertices() with these settings
    // returns  [points]
    std::vector<LightHalves> light_points(std::span<const TracedPoint> points,
                                          const DirectLight& light, const TraceSettings& settings,
                                          const VertexLight& of_mesh,
                                          const VertexLight* of_still = nullptr) const;

  private:
    struct Place {
        RayStart start;
        Vec3f normal;
        uint32_t vertex;
        uint64_t key;
    };
    class Bounces;

    Place place_of(const TracedPoint& point, uint64_t key) const;

    TracedMesh all_;  // the mesh, then the still one
    uint32_t num_vertices_;
    RayScene scene_;
    RayStarts starts_;
    std::vector<float> offsets_;  // [V] of the mesh
};

}  // namespace paim
