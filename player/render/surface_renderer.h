// Draws surfaces in the colours of their vertices, or of the images on their faces.
#pragma once

#include <optional>

#include "paim/mesh/root_motion.h"
#include "player/render/frame.h"
#include "player/render/picture_program.h"
#include "player/render/surface_mesh.h"
#include "player/render/textured_faces.h"

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
    // aspect    of the whole picture
    // textured  of the surface, to draw images on their faces; nullptr: colours of vertices alone
    void draw(SurfaceMesh& surface, size_t num_triangles, const SurfacePlace& place,
              const Frame& frame, float aspect, TexturedFaces* textured = nullptr);

  private:
    // What stands in one place: triangles [first, last) of the surface, or of the textured faces.
    struct Faces {
        SurfaceMesh& surface;
        size_t first, last;
        TexturedFaces* textured;
        TexturedFaces::Place place;
    };
    void draw_in_place(const Faces& faces, const RigidTransform& root, const Frame& frame,
                       float aspect);
    void draw_faces(const Faces& faces, const glm::mat4& matrix, const Frame& frame);

    PictureProgram program_;
    std::optional<PictureProgram> textured_program_;  // made when it is first used
};

}  // namespace paim::player
