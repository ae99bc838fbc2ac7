// What has changed since the last frame, and who decodes.
#include "player/render/vertex_source.h"

#include "paim/base/error.h"
#include "player/gl/context.h"
#include "player/render/cpu_vertices.h"
#include "player/render/shader_vertices.h"

namespace paim::player {

void VertexSource::update(double time, const DecodeLimits& limits, const LightCoefficients* light,
                          std::span<SurfaceMesh> parts) {
    const Changes changed = changes(time, limits, light);
    if (!changed.positions && !changed.colors) return;
    // Where writing fails, all is written the next time.
    pose_.reset();
    if (changed.colors) lit_.reset();
    write(time, limits, light, changed, parts);
    pose_ = {time, limits.geometry_components};
    if (changed.colors) lit_ = {time, limits, *light};
}

VertexSource::Changes VertexSource::changes(double time, const DecodeLimits& limits,
                                            const LightCoefficients* light) const {
    const bool same_pose = pose_ == Pose{time, limits.geometry_components};
    const bool same_light = lit_ && light != nullptr && lit_->time == time &&
                            lit_->limits == limits && lit_->light.values == light->values;
    return {!same_pose, light != nullptr && !same_light};
}

std::unique_ptr<VertexSource> make_vertex_source(const std::shared_ptr<const Asset>& asset,
                                                 const DecodeLimits& limits, Decoder decoder) {
    const auto on_cpu = [&] { return std::make_unique<CpuVertices>(asset, limits); };
    if (decoder == Decoder::cpu) return on_cpu();
    if (decoder == Decoder::gpu) return std::make_unique<ShaderVertices>(asset, limits);
    if (gl::draws_in_software()) return on_cpu();
    try {
        return std::make_unique<ShaderVertices>(asset, limits);
    } catch (
        const Error&) {  // of a driver whose textures are too small, or of a codec without shader
        return on_cpu();
    }
}

}  // namespace paim::player
