// One ShaderMesh for each part.
#include "player/render/shader_vertices.h"

#include <algorithm>
#include <utility>

namespace paim::player {

ShaderVertices::ShaderVertices(std::shared_ptr<const Asset> asset, const DecodeLimits& limits)
    : VertexSource(*asset), asset_(std::move(asset)) {
    for (const CodedMesh& mesh : asset_->parts) {
        meshes_.push_back(std::make_unique<ShaderMesh>(mesh, limits));
        glosses_.push_back(mesh.gloss ? std::make_unique<GlossPlayer>(mesh) : nullptr);
    }
    is_placed_.resize(meshes_.size(), false);
    most_bands_ = std::min(limits.bands, asset_->moving().light_bands());
}

DecodeLimits ShaderVertices::most() const {
    const UploadPlan& plan = meshes_.front()->plan();
    return {plan.geometry_components, plan.transfer_components, most_bands_,
            plan.vertex_components};
}

uint64_t ShaderVertices::texture_bytes() const {
    uint64_t bytes = 0;
    for (const auto& mesh : meshes_) bytes += mesh->texture_bytes();
    return bytes;
}

void ShaderVertices::write(double time, const DecodeLimits& limits, const LightCoefficients* light,
                           std::span<const Changes> changes, std::span<SurfaceMesh> parts) {
    for (size_t j = 0; j < parts.size(); ++j) {
        if (changes[j].positions) {
            meshes_[j]->decode(time, limits, parts[j].positions());
            is_placed_[j] = false;
        }
        if (changes[j].colors) meshes_[j]->light(time, limits, *light, parts[j].lit());
        if (!changes[j].gloss) continue;
        // Outgoing coefficients are few, and are computed on the CPU, as are the frames.
        const CodedMesh& mesh = asset_->parts[j];
        const double own_time = mesh.num_poses() == 1 ? 0.0 : time;
        if (!is_placed_[j]) {
            const uint32_t components =
                std::min(limits.geometry_components, most().geometry_components);
            decoder_.decode(mesh.positions, own_time, components, positions_);
            glosses_[j]->place(positions_);
            is_placed_[j] = true;
        }
        glosses_[j]->light(own_time, limits, to_local(*light, root_at(mesh.root_motion, own_time)));
        parts[j].gloss()->upload(glosses_[j]->exit_radiance());
    }
}

}  // namespace paim::player
