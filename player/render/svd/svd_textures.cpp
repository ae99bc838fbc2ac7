// Codec svd in textures: the matrix, and the light in its steps.
#include "player/render/svd/svd_textures.h"

#include <algorithm>

#include "paim/base/error.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim::player {

namespace {

PlaneGroups groups_of(const CodedMesh& mesh, const UploadPlan& plan) {
    return {mesh.topology.num_vertices, mesh.layout.channels, mesh.layout.num_coefficients(),
            plan.layout.num_coefficients(), plan.groups_per_channel()};
}

// Of the largest texture that transfer takes.
int64_t largest_svd_texture(const CodedMesh& mesh, const UploadPlan& plan, int max_texture_size) {
    const int64_t components =
        svd_transfer_texels(mesh, plan.transfer_components, plan.layout.in_bands);
    const int64_t mean = int64_t{plan.num_groups()} * mesh.topology.num_vertices;
    require_fit("transfer", plan.transfer_components, components, max_texture_size);
    if (mean > texel_capacity(max_texture_size)) {
        throw_unsupported(
            "the mean transfer of {} vertices needs {} texels, this driver's largest texture "
            "(GL_MAX_TEXTURE_SIZE {}) holds {}: lower --bands",
            mesh.topology.num_vertices, mean, max_texture_size, texel_capacity(max_texture_size));
    }
    return std::max({components, mean, int64_t{plan.transfer_components}});
}

}  // namespace

TransferUploader svd_uploader() {
    return {SvdTransfer::kName, largest_svd_texture,
            [](const CodedMesh& mesh, const UploadPlan& plan) -> std::unique_ptr<TransferTextures> {
                return std::make_unique<SvdTextures>(mesh, plan);
            }};
}

int64_t svd_transfer_texels(const CodedMesh& mesh, uint32_t num_components, uint32_t bands) {
    const LowRank& matrix = mesh.transfer->matrix;
    return int64_t{std::min(num_components, matrix.num_components)} * mesh.layout.channels *
           groups_of(mesh.layout.with_bands(bands)) * mesh.topology.num_vertices;
}

SvdTextures::SvdTextures(const CodedMesh& mesh, const UploadPlan& plan)
    : mesh_(mesh),
      plan_(plan),
      matrix_("transfer", mesh.transfer->matrix, groups_of(mesh, plan), plan.transfer_components,
              plan.width_log2),
      light_("the light", gl::TexelFormat::rgba32f, plan.width_log2,
             int64_t{3} * plan.groups_per_channel()) {}

// Multiplied by the steps that the transfer counts, so that vertices never are.
void SvdTextures::update_light(const LightCoefficients& light, uint32_t bands) {
    const auto lit_bands = std::min(static_cast<int>(bands), light.bands);
    const size_t stride = size_t{plan_.groups_per_channel()} * kGroupSize;
    scratch_.assign(3 * stride, 0.0f);
    for (uint32_t i = 0; i < static_cast<uint32_t>(sh::num_coefficients(lit_bands)); ++i) {
        for (uint32_t channel = 0; channel < 3; ++channel) {
            const uint32_t plane = mesh_.layout.plane(mesh_.layout.channels == 3 ? channel : 0, i);
            scratch_[channel * stride + i] =
                mesh_.transfer->matrix.step(plane) * light.values[i][channel];
        }
    }
    light_.update(scratch_);
}

int SvdTextures::bind(const gl::Program& program, int unit, double time, const DecodeLimits& limits,
                      const LightCoefficients& light) {
    const uint32_t bands = std::min(limits.bands, plan_.layout.in_bands);
    update_light(light, bands);
    unit = matrix_.bind(program, unit, time, limits.transfer_components);
    program.set_texture("light", unit++, light_.handle());
    program.set("num_channels", static_cast<int>(plan_.layout.channels));
    program.set("groups_per_channel", static_cast<int>(plan_.groups_per_channel()));
    program.set("groups_in_use", static_cast<int>(groups_of(plan_.layout.with_bands(bands))));
    return unit;
}

}  // namespace paim::player
