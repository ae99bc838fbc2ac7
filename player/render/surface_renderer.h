// Draws surfaces in the colours of their vertices.
#pragma once

#include "paim/mesh/root_motion.h"
#include "player/render/frame.h"
#include "player/render/picture_program.h"
#include "player/render/surface_mesh.h"

namespace paim::player {

// Where the triangles of a surface stand in the scene.
struct SurfacePlace {
    size_t num_following =
        0;  // triangles, from the first, that stand like `root`; a floor does not
    RigidTransform root = {};
    Vec3d offset = Vec3d::Zero();  // of all triangles, scene units
};

class SurfaceRenderer {
  public:
    SurfaceRenderer();

    // Draws over what the current target holds.
    // aspect  of the whole picture
    void draw(SurfaceMesh& surface, size_t num_triangles, const SurfacePlace& place,
              const Frame& frame, float aspect) const;

  private:
    void draw_triangles(SurfaceMesh& surface, size_t first, size_t last, const RigidTransform& root,
                        const Frame& frame, float aspect) const;

    PictureProgram program_;
};

}  // namespace paim::player
