// Light that leaves points of glossy and diffuse surfaces, by tracing paths: what pictures from
// spherical harmonics are measured against.
// Based on: Kajiya, The Rendering Equation, 1986; Veach and Guibas, Optimally Combining Sampling
//           Techniques for Monte Carlo Rendering, 1995 (the balance heuristic)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "analysis/reference/path/path_light.h"
#include "analysis/reference/path/path_reflection.h"
#include "analysis/reference/traced_mesh.h"
#include "compressor/bake/sobol.h"
#include "paim/trace/ray_scene.h"

namespace paim {

struct PathSettings {
    uint32_t bounces = 0;  // light that was reflected at most so often before it reaches the point
    uint64_t seed = 1;
    uint32_t batches = 16;  // independent of each other, at least 2
    uint32_t paths = 64;    // of a batch
    PathKinds seen;         // what the point itself reflects; other surfaces reflect all
};

// A point that is seen.
struct PathStart {
    TracedPoint point;
    Vec3f out;  // unit, towards the eye
};

// Radiance, with the standard error of its mean over the batches.
struct PathEstimate {
    Vec3f mean = Vec3f::Zero(), standard_error = Vec3f::Zero();
};

// Surfaces are as the bake has them: normals, albedos and glossy reflection are interpolated over the
// triangles, and triangles give no light on their back. A direction below the interpolated normal's
// plane sees the mirror image of what lies above it, as the outgoing functions of glossy transfer are
// continued. Bounces are counted as in the bake (docs/algorithms/bounces.md).
class PathTracer {
  public:
    // Keeps references to the materials and the light.
    // Errors: those of RayScene.
    PathTracer(TracedMesh mesh, const PathMaterials& materials, const PathLight& light);

    // Deterministic on any number of threads. Random numbers are keyed by (seed, number of the
    // start, batch).
    // returns  [starts]
    std::vector<PathEstimate> trace(std::span<const PathStart> starts,
                                    const PathSettings& settings) const;

  private:
    class Walk;

    TracedMesh mesh_;
    const PathMaterials& materials_;
    const PathLight& light_;
    RayScene scene_;
    std::vector<float> offsets_;  // [V]
};

}  // namespace paim
