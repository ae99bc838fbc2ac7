// Draws surfaces in the colours of their vertices, or of the images on their faces.
#pragma once

#include <map>
#include <string_view>

#include "paim/mesh/root_motion.h"
#include "player/render/frame.h"
#include "player/render/gloss_shader.h"
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
    void draw_faces(const Faces& faces, const RigidTransform& root, const glm::mat4& matrix,
                    const Frame& frame);

    // Those of surfaces without gloss and of each kind of gloss, made when they are first used.
    using Programs = std::map<GlossShader, PictureProgram>;
    const gl::Program& use(Programs& programs, const char* name, std::string_view vertex_source,
                           std::string_view fragment_source, const Faces& faces,
                           const RigidTransform& root, const Frame& frame);

    Programs plain_, textured_;
};

}  // namespace paim::player
