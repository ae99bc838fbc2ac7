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
                           const Frame& frame, float aspect) const {
    RigidTransform root = place.root;
    root.translation += place.offset;
    draw_triangles(surface, 0, place.num_following, root, frame, aspect);
    root = {Eigen::Quaterniond::Identity(), place.offset};
    draw_triangles(surface, place.num_following, num_triangles, root, frame, aspect);
}

void SurfaceRenderer::draw_triangles(SurfaceMesh& surface, size_t first, size_t last,
                                     const RigidTransform& root, const Frame& frame,
                                     float aspect) const {
    if (first == last) return;
    const DepthRange depth = depth_range(frame.camera, frame.bounds);
    const gl::Program& program = program_.use(frame.display);
    program.set("clip_from_local",
                clip_from_local(frame.camera, aspect, depth, frame.region, root));
    program.set("edge_color", kNoEdges);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    if (!frame.edges) return surface.draw(first, last);
    // Surfaces are moved back a little, so that their edges are seen.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 1.0f);
    surface.draw(first, last);
    glDisable(GL_POLYGON_OFFSET_FILL);
    program.set("edge_color", kEdges);
    surface.draw_edges(first, last);
}

}  // namespace paim::player
