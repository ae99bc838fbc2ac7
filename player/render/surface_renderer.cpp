// Triangles, and their edges over them.
#include "player/render/surface_renderer.h"

#include "player/render/clip_from_local.h"
#include "player/render/depth_range.h"
#include "player/shaders/sources.h"

namespace paim::player {

namespace {

const Eigen::Vector4f kNoEdges(0.0f, 0.0f, 0.0f, 0.0f);
const Eigen::Vector4f kEdges(0.0f, 0.0f, 0.0f, 1.0f);

}  // namespace

SurfaceRenderer::SurfaceRenderer()
    : program_("surface", shaders::surface_vert, shaders::surface_frag) {}

void SurfaceRenderer::draw(SurfaceMesh& surface, size_t num_triangles, const SurfacePlace& place,
                           const Frame& frame, float aspect, TexturedFaces* textured) {
    using enum TexturedFaces::Place;
    RigidTransform root = place.root;
    root.translation += place.offset;
    draw_in_place({surface, 0, place.num_following, textured, following}, root, frame, aspect);
    root = {Eigen::Quaterniond::Identity(), place.offset};
    draw_in_place({surface, place.num_following, num_triangles, textured, floor}, root, frame,
                  aspect);
}

void SurfaceRenderer::draw_in_place(const Faces& faces, const RigidTransform& root,
                                    const Frame& frame, float aspect) {
    if (faces.first == faces.last) return;
    const DepthRange depth = depth_range(frame.camera, frame.bounds);
    const glm::mat4 matrix = clip_from_local(frame.camera, aspect, depth, frame.region, root);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    if (!frame.edges) return draw_faces(faces, matrix, frame);
    // Surfaces are moved back a little, so that their edges are seen.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 1.0f);
    draw_faces(faces, matrix, frame);
    glDisable(GL_POLYGON_OFFSET_FILL);
    const gl::Program& program = program_.use(frame.display);
    program.set("clip_from_local", matrix);
    program.set("edge_color", kEdges);
    faces.surface.draw_edges(faces.first, faces.last);
}

void SurfaceRenderer::draw_faces(const Faces& faces, const glm::mat4& matrix, const Frame& frame) {
    const gl::Program& program = program_.use(frame.display);
    program.set("clip_from_local", matrix);
    program.set("edge_color", kNoEdges);
    if (faces.textured == nullptr) return faces.surface.draw(faces.first, faces.last);
    faces.textured->draw_plain(faces.place);
    if (!textured_program_) {
        textured_program_.emplace("textured surface", TexturedFaces::shader_source(),
                                  shaders::textured_frag);
    }
    const gl::Program& textured_program = textured_program_->use(frame.display);
    textured_program.set("clip_from_local", matrix);
    faces.textured->draw_images(faces.place, faces.surface, textured_program);
}

}  // namespace paim::player
