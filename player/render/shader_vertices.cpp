// One ShaderMesh for each part.
#include "player/render/shader_vertices.h"

#include <utility>

namespace paim::player {

ShaderVertices::ShaderVertices(std::shared_ptr<const Asset> asset, const DecodeLimits& limits)
    : VertexSource(*asset), asset_(std::move(asset)) {
    for (const CodedMesh& mesh : asset_->parts) {
        meshes_.push_back(std::make_unique<ShaderMesh>(mesh, limits));
    }
}

DecodeLimits ShaderVertices::most() const {
    const UploadPlan& plan = meshes_.front()->plan();
    return {plan.geometry_components, plan.transfer_components, plan.layout.in_bands,
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
        if (changes[j].positions) meshes_[j]->decode(time, limits, parts[j].positions());
        if (changes[j].colors) meshes_[j]->light(time, limits, *light, parts[j].lit());
    }
}

}  // namespace paim::player
