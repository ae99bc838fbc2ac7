// Pictures of baked poses by traced light, without spherical harmonics: the truth that errors are
// measured against.
#pragma once

#include <memory>
#include <vector>

#include "analysis/reference/reference_pictures.h"
#include "analysis/reference/traced_scene.h"
#include "analysis/stage.h"

namespace paim {

// How radiance gets into pixels.
enum class TracedAt {
    vertices,  // traced at vertices and interpolated over triangles, as players draw it
    pixels,    // traced at what each pixel shows
};

// Traces the poses of a bake on a stage: the same geometry, normals, colours and bounces as the bake's.
// Light comes from the maps in full resolution.
class TracedReference {
  public:
    // Keeps references to the bake and the stage.
    // rays  of a vertex or pixel under each light, and half as many for each bounce; a multiple of 4
    TracedReference(const BakeReader& bake, const Stage& stage, uint32_t rays);
    ~TracedReference();

    uint32_t rays(size_t light) const { return lights_[light].rays(); }
    // The largest number of all lights.
    uint32_t most_rays() const;
    // Of this light from now on.
    void set_rays(size_t light, uint32_t rays);

    // Pose p as baked.
    ReferencePictures trace(uint32_t p, TracedAt at) const;

  private:
    struct Pose;

    TraceSettings settings_for(size_t light, uint32_t pose) const;
    VertexLight light_moving(const Pose& pose, size_t light) const;
    // With the rays that the light has now.
    void light_still_mesh(size_t light);
    const VertexLight* still_light(size_t light) const;
    void trace_pixels(const Pose& pose, ReferencePictures& out) const;

    const BakeReader& bake_;
    const Stage& stage_;
    std::vector<uint32_t> rays_;                // [lights]
    std::vector<LightSampler> samplers_;        // [lights]
    std::vector<DirectLight> lights_;           // [lights]
    TracedMesh still_mesh_;                     // scaled as on the stage
    std::unique_ptr<TracedScene> still_scene_;  // if there is a still mesh
    std::vector<VertexLight> still_lights_;     // [lights]
};

}  // namespace paim
