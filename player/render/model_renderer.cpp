// Uploading a model and drawing it.
#include "player/render/model_renderer.h"

#include <algorithm>
#include <limits>

#include "paim/base/error.h"
#include "paim/codec/low_rank.h"
#include "player/gl/check.h"
#include "player/render/clip_from_world.h"
#include "player/render/depth_range.h"
#include "player/render/group_gather.h"
#include "player/shaders/sources.h"

namespace paim::player {

namespace {

using gl::DataTexture;
using gl::TexelFormat;

TexelFormat component_format(const LowRankMatrix& matrix) {
    return matrix.precision == Precision::f16 ? TexelFormat::rgba16f : TexelFormat::rgba32f;
}

// Textures have at least one texel, even of an empty model or of no components.
int64_t at_least_one(int64_t num_texels) {
    return std::max<int64_t>(1, num_texels);
}

// Mean and components of one part, as upload() asks for them.
struct PartView {
    const LowRankMatrix& matrix;
    PlaneView planes;  // of any of them

    void gather_mean(int64_t first, std::span<float> out) const {
        PlaneView mean = planes;
        mean.values = &matrix.mean;
        gather_groups(mean, first, out);
    }

    void gather_components(int64_t first, std::span<float> out) const {
        const int64_t stride = texels_per_component();
        while (!out.empty()) {
            const int64_t k = first / stride;
            const int64_t texel = first % stride;
            const auto count =
                std::min<size_t>(out.size(), static_cast<size_t>(stride - texel) * kGroupSize);
            PlaneView component = planes;
            component.values = &matrix.components[static_cast<size_t>(k)];
            gather_groups(component, texel, out.first(count));
            out = out.subspan(count);
            first += static_cast<int64_t>(count / kGroupSize);
        }
    }

    int64_t texels_per_component() const {
        const uint32_t num_channels = matrix.num_planes / planes.planes_per_channel;
        return int64_t{num_channels} * planes.groups_per_channel * planes.num_vertices;
    }
};

void upload_part(const PartView& part, const DataTexture& mean, const DataTexture& components,
                 uint32_t num_components) {
    if (part.planes.num_vertices == 0) return;
    mean.upload([&](int64_t first, std::span<float> out) { part.gather_mean(first, out); });
    if (num_components == 0) return;
    components.upload(
        [&](int64_t first, std::span<float> out) { part.gather_components(first, out); });
}

}  // namespace

ModelRenderer::ModelRenderer(const Model& model, const DecodeLimits& limits)
    : model_(model),
      plan_(plan_upload(model, limits, gl::max_texture_size())),
      program_("model", shaders::model_vert, shaders::model_frag),
      geometry_mean_("the mean geometry", TexelFormat::rgba32f, plan_.width_log2,
                     at_least_one(model.topology.num_vertices)),
      geometry_components_("the geometry components", component_format(model.geometry),
                           plan_.width_log2,
                           at_least_one(geometry_texels(model, plan_.geometry_components))),
      geometry_weights_("the geometry weights", TexelFormat::r32f, plan_.width_log2,
                        at_least_one(plan_.geometry_components)),
      transfer_mean_("the mean transfer", TexelFormat::rgba32f, plan_.width_log2,
                     at_least_one(int64_t{plan_.num_groups()} * model.topology.num_vertices)),
      transfer_components_(
          "the transfer components", component_format(model.transfer), plan_.width_log2,
          at_least_one(transfer_texels(model, plan_.transfer_components, plan_.layout.bands))),
      transfer_weights_("the transfer weights", TexelFormat::r32f, plan_.width_log2,
                        at_least_one(plan_.transfer_components)),
      light_("the light", TexelFormat::rgba32f, plan_.width_log2,
             int64_t{3} * plan_.groups_per_channel),
      albedo_("the albedo", TexelFormat::rgba32f, plan_.width_log2,
              at_least_one(static_cast<int64_t>(model.albedo.values.size()))) {
    const uint32_t num_vertices = model.topology.num_vertices;
    upload_part({model.geometry, {nullptr, model.geometry.steps, num_vertices, 3, 3, 1}},
                geometry_mean_, geometry_components_, plan_.geometry_components);
    upload_part({model.transfer,
                 {nullptr, model.transfer.steps, num_vertices, model.layout.num_coefficients(),
                  plan_.layout.num_coefficients(), plan_.groups_per_channel}},
                transfer_mean_, transfer_components_, plan_.transfer_components);
    upload_albedo();
    upload_triangles();
}

void ModelRenderer::upload_albedo() const {
    albedo_.upload([&](int64_t first, std::span<float> out) {
        for (size_t i = 0; i < out.size(); i += 4) {
            const Vec3f& value = model_.albedo.values[static_cast<size_t>(first) + i / 4];
            std::copy_n(value.data(), 3, out.data() + i);
        }
    });
}

void ModelRenderer::upload_triangles() {
    const auto& triangles = model_.topology.triangles;
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

void ModelRenderer::update_weights(const LowRankMatrix& matrix, double time,
                                   const gl::DataTexture& texture) {
    interpolate_weights(matrix, time, scratch_);
    scratch_.resize(std::min(scratch_.size(), static_cast<size_t>(texture.num_texels())));
    texture.update(scratch_);
}

void ModelRenderer::update_light(const LightCoefficients& light, uint32_t bands) {
    const uint32_t lit_bands = std::min(bands, static_cast<uint32_t>(light.bands));
    const size_t stride = size_t{plan_.groups_per_channel} * kGroupSize;
    scratch_.assign(3 * stride, 0.0f);
    for (size_t i = 0; i < size_t{lit_bands} * lit_bands; ++i) {
        for (size_t channel = 0; channel < 3; ++channel) {
            scratch_[channel * stride + i] = light.values[i][static_cast<Eigen::Index>(channel)];
        }
    }
    light_.update(scratch_);
}

void ModelRenderer::draw(const Frame& frame, const LightCoefficients& light, float aspect) {
    const uint32_t bands = std::min(frame.limits.bands, plan_.layout.bands);
    update_weights(model_.geometry, frame.time, geometry_weights_);
    update_weights(model_.transfer, frame.time, transfer_weights_);
    update_light(light, bands);

    program_.use();
    program_.set_texture("geometry_mean", 0, geometry_mean_.handle());
    program_.set_texture("geometry_components", 1, geometry_components_.handle());
    program_.set_texture("geometry_weights", 2, geometry_weights_.handle());
    program_.set_texture("transfer_mean", 3, transfer_mean_.handle());
    program_.set_texture("transfer_components", 4, transfer_components_.handle());
    program_.set_texture("transfer_weights", 5, transfer_weights_.handle());
    program_.set_texture("light", 6, light_.handle());
    program_.set_texture("albedo", 7, albedo_.handle());
    const auto integer = [&](const char* name, uint32_t value) {
        program_.set(name, static_cast<int>(value));
    };
    program_.set("width_log2", plan_.width_log2);
    integer("num_vertices", model_.topology.num_vertices);
    integer("num_geometry_components",
            std::min(frame.limits.geometry_components, plan_.geometry_components));
    integer("num_transfer_components",
            std::min(frame.limits.transfer_components, plan_.transfer_components));
    integer("num_channels", plan_.layout.channels);
    integer("groups_per_channel", plan_.groups_per_channel);
    integer("groups_in_use", (bands * bands + kGroupSize - 1) / kGroupSize);
    integer("albedo_stride", model_.albedo.values.size() == 1 ? 0 : 1);
    const DepthRange depth = depth_range(frame.camera, frame.bounds);
    program_.set("clip_from_world", clip_from_world(frame.camera, aspect, depth));

    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(vertex_array_.id());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(model_.topology.triangles.size() * 3),
                   GL_UNSIGNED_INT, nullptr);
}

}  // namespace paim::player
