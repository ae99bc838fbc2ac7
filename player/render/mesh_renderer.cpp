// Uploading a mesh and drawing it.
#include "player/render/mesh_renderer.h"

#include <algorithm>
#include <limits>

#include "paim/base/error.h"
#include "player/gl/check.h"
#include "player/render/clip_from_local.h"
#include "player/render/depth_range.h"
#include "player/render/plan_upload.h"
#include "player/render/value_textures.h"
#include "player/shaders/sources.h"

namespace paim::player {

MeshRenderer::MeshRenderer(const CodedMesh& mesh, const DecodeLimits& limits)
    : mesh_(mesh),
      num_following_triangles_(mesh.topology.num_triangles_before(mesh.num_following)),
      plan_(plan_upload(mesh, limits, gl::max_texture_size())),
      geometry_("geometry", mesh.positions, {mesh.topology.num_vertices, 1, 3, 3, 1},
                plan_.geometry_components, plan_.width_log2),
      transfer_(find_uploader(mesh).upload(mesh, plan_)),
      program_("model", shaders::model_vert, shaders::model_frag,
               geometry_.defines() + transfer_->defines()),
      albedo_("the albedo", gl::TexelFormat::rgba32f, plan_.width_log2,
              at_least_one(static_cast<int64_t>(mesh.albedo.values.size()))) {
    upload_albedo();
    upload_triangles();
}

uint64_t MeshRenderer::texture_bytes() const {
    return geometry_.size_bytes() + transfer_->size_bytes() + albedo_.size_bytes();
}

void MeshRenderer::upload_albedo() const {
    albedo_.upload([&](int64_t first, std::span<float> out) {
        for (size_t i = 0; i < out.size(); i += 4) {
            const Vec3f& value = mesh_.albedo.values[static_cast<size_t>(first) + i / 4];
            std::copy_n(value.data(), 3, out.data() + i);
        }
    });
}

void MeshRenderer::upload_triangles() {
    const auto& triangles = mesh_.topology.triangles;
    if (triangles.size() > std::numeric_limits<GLsizei>::max() / 3) {
        throw_unsupported("{} triangles, OpenGL draws at most {} at once", triangles.size(),
                          std::numeric_limits<GLsizei>::max() / 3);
    }
    glBindVertexArray(vertex_array_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(triangles.size() * sizeof(Triangle)), triangles.data(),
                 GL_STATIC_DRAW);
    gl::check_errors("uploading the triangles");
}

void MeshRenderer::draw(const Frame& frame, const LightCoefficients& light, float aspect) {
    const RigidTransform root = root_at(mesh_.root_motion, frame.time);
    draw_triangles(0, num_following_triangles_, root, frame, light, aspect);
    draw_triangles(num_following_triangles_, mesh_.topology.triangles.size(), {}, frame, light,
                   aspect);
}

void MeshRenderer::draw_triangles(size_t first, size_t last, const RigidTransform& root,
                                  const Frame& frame, const LightCoefficients& light,
                                  float aspect) {
    if (first == last) return;
    program_.use();
    int unit = geometry_.bind(program_, 0, frame.time, frame.limits.geometry_components);
    unit = transfer_->bind(program_, unit, frame, to_local(light, root));
    program_.set_texture("albedo", unit, albedo_.handle());
    program_.set("width_log2", plan_.width_log2);
    program_.set("num_vertices", static_cast<int>(mesh_.topology.num_vertices));
    program_.set("albedo_stride", mesh_.albedo.values.size() == 1 ? 0 : 1);
    const LowRank& geometry = mesh_.positions;
    program_.set("geometry_step", Vec3f(geometry.step(0), geometry.step(1), geometry.step(2)));
    const DepthRange depth = depth_range(frame.camera, frame.bounds);
    program_.set("clip_from_local",
                 clip_from_local(frame.camera, aspect, depth, frame.region, root));

    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(vertex_array_.id());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * (last - first)), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first * sizeof(Triangle)));
}

}  // namespace paim::player
