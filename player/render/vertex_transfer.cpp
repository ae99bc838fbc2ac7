// The matrix, and the light in its steps.
#include "player/render/vertex_transfer.h"

#include <algorithm>

namespace paim::player {

namespace {

PlaneGroups planes_of(const Asset& model, const UploadPlan& plan) {
    return {model.moving().topology.num_vertices, model.moving().layout.channels, model.moving().layout.num_coefficients(),
            plan.layout.num_coefficients(), plan.groups_per_channel};
}

}  // namespace

VertexTransfer::VertexTransfer(const Asset& model, const UploadPlan& plan)
    : model_(model),
      plan_(plan),
      matrix_("transfer", model.moving().transfer->matrix, planes_of(model, plan), plan.transfer_components,
              plan.width_log2),
      light_("the light", gl::TexelFormat::rgba32f, plan.width_log2,
             int64_t{3} * plan.groups_per_channel) {}

// Multiplied by the steps that the transfer counts, so that vertices never are.
void VertexTransfer::update_light(const LightCoefficients& light, uint32_t bands) {
    const uint32_t lit_bands = std::min(bands, static_cast<uint32_t>(light.bands));
    const size_t stride = size_t{plan_.groups_per_channel} * kGroupSize;
    scratch_.assign(3 * stride, 0.0f);
    for (uint32_t i = 0; i < lit_bands * lit_bands; ++i) {
        for (uint32_t channel = 0; channel < 3; ++channel) {
            const uint32_t plane =
                model_.moving().layout.plane(model_.moving().layout.channels == 3 ? channel : 0, i);
            scratch_[channel * stride + i] = model_.moving().transfer->matrix.step(plane) * light.values[i][channel];
        }
    }
    light_.update(scratch_);
}

int VertexTransfer::bind(const gl::Program& program, int unit, const Frame& frame,
                         const LightCoefficients& light) {
    const uint32_t bands = std::min(frame.limits.bands, plan_.layout.in_bands);
    update_light(light, bands);
    unit = matrix_.bind(program, unit, frame.time, frame.limits.transfer_components);
    program.set_texture("light", unit++, light_.handle());
    program.set("num_channels", static_cast<int>(plan_.layout.channels));
    program.set("groups_per_channel", static_cast<int>(plan_.groups_per_channel));
    program.set("groups_in_use", static_cast<int>((bands * bands + kGroupSize - 1) / kGroupSize));
    return unit;
}

}  // namespace paim::player
