// Triangles, and their edges over them.
#include "player/render/surface_renderer.h"

#include <string>

#include "player/render/clip_from_local.h"
#include "player/render/depth_range.h"
#include "player/shaders/sources.h"

namespace paim::player {

namespace {

const Eigen::Vector4f kNoEdges(0.0f, 0.0f, 0.0f, 0.0f);
const Eigen::Vector4f kEdges(0.0f, 0.0f, 0.0f, 1.0f);
constexpr int kGlossUnit = 6;  // textured faces use those before it

// How the gloss of a surface is shown. Colours to show instead of radiance have none.
GlossShader shader_of(const SurfaceMesh& surface, const Frame& frame) {
    if (surface.gloss() == nullptr || frame.colors || frame.gloss == GlossDetail::none) return {};
    const uint32_t out_bands = surface.gloss()->out_bands();
    const bool fits = out_bands <= most_out_bands_at_pixels();
    return {fits ? frame.gloss : GlossDetail::vertex, out_bands};
}

}  // namespace

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
    if (!frame.edges) return draw_faces(faces, root, matrix, frame);
    // Surfaces are moved back a little, so that their edges are seen.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 1.0f);
    draw_faces(faces, root, matrix, frame);
    glDisable(GL_POLYGON_OFFSET_FILL);
    const gl::Program& program = plain_.at(shader_of(faces.surface, frame)).use(frame.display);
    program.set("clip_from_local", matrix);
    program.set("edge_color", kEdges);
    faces.surface.draw_edges(faces.first, faces.last);
}

const gl::Program& SurfaceRenderer::use(Programs& programs, const char* name,
                                        std::string_view vertex_source,
                                        std::string_view fragment_source, const Faces& faces,
                                        const RigidTransform& root, const Frame& frame) {
    const GlossShader shader = shader_of(faces.surface, frame);
    auto found = programs.find(shader);
    if (found == programs.end()) {
        found =
            programs
                .try_emplace(shader, name, gloss_vertex_source(shader) + std::string(vertex_source),
                             gloss_fragment_source(shader) + std::string(fragment_source))
                .first;
    }
    const gl::Program& program = found->second.use(frame.display);
    if (shader.detail != GlossDetail::none) {
        const Vec3f eye = root.to_local(frame.camera.eye.cast<double>()).cast<float>();
        faces.surface.gloss()->set(program, kGlossUnit, eye);
    }
    return program;
}

void SurfaceRenderer::draw_faces(const Faces& faces, const RigidTransform& root,
                                 const glm::mat4& matrix, const Frame& frame) {
    const gl::Program& program =
        use(plain_, "surface", shaders::surface_vert, shaders::surface_frag, faces, root, frame);
    program.set("clip_from_local", matrix);
    program.set("edge_color", kNoEdges);
    if (faces.textured == nullptr) return faces.surface.draw(faces.first, faces.last);
    faces.textured->draw_plain(faces.place);
    const gl::Program& textured = use(textured_, "textured surface", TexturedFaces::shader_source(),
                                      shaders::textured_frag, faces, root, frame);
    textured.set("clip_from_local", matrix);
    faces.textured->draw_images(faces.place, faces.surface, textured);
}

}  // namespace paim::player
