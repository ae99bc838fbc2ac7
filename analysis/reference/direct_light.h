// Light from an environment map that arrives at a point past all that blocks it, by tracing rays.
// Based on: Veach and Guibas, Optimally Combining Sampling Techniques for Monte Carlo Rendering,
//           1995 (the balance heuristic)
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/reference/light_sampler.h"
#include "compressor/bake/cosine_directions.h"
#include "compressor/bake/ray_start.h"
#include "paim/trace/ray_scene.h"

namespace paim {

// Two independent estimates of the same expectation. Their mean is the estimate, and half their
// difference has the variance of its error.
using LightHalves = std::array<Vec3f, 2>;

// Half of the rays follow the cosine, half follow the light. Each is weighted by the density of both
// together, so that the estimate is unbiased, and small suns and wide skies are both found. Directions
// that follow the light are drawn once, in sets of which every point takes one for each half. Sixteen
// neighbours of a set lie close together, so that their rays do.
class DirectLight {
  public:
    // rays  of a point, a multiple of 4, at least 4 (checked)
    // seed  of the sets
    // Keeps a reference to the light.
    DirectLight(const LightSampler& light, uint32_t rays, uint64_t seed);

    uint32_t rays() const { return 4 * num_points_; }

    // Scratch memory of one thread.
    struct Workspace {
        DirectionArrays directions;
        std::vector<float> occluded;
        std::vector<const LightSampler::Sample*> samples;
    };

    // 1/π ∫ L(ω) V(ω) max(0, n·ω) dω: what a point of albedo 1 reflects.
    // normal  unit
    // key     of the point's random numbers
    LightHalves at(const RayScene& scene, const RayStart& start, const Vec3f& normal, uint64_t key,
                   Workspace& work) const;

  private:
    using LightSet = std::vector<LightSampler::Sample>;

    LightSet make_set(uint64_t key) const;
    Vec3d sum_cosine(const RayScene& scene, const RayStart& start, const Vec3f& normal,
                     uint64_t key, Workspace& work) const;
    Vec3d sum_light(const RayScene& scene, const RayStart& start, const Vec3f& normal,
                    const LightSet& set, Workspace& work) const;

    const LightSampler* light_;
    uint32_t num_points_;  // of each kind in a half
    CosineDirections cosine_;
    std::array<std::vector<LightSet>, 2> sets_;  // [half][kSets], or empty if the light is black
};

}  // namespace paim
