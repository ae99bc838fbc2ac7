// Playback, and its results as attributes.
#include "player/render/cpu_vertices.h"

#include <algorithm>
#include <utility>

#include "player/render/lower_limits.h"

namespace paim::player {

namespace {

DecodeLimits all_of(const CodedMesh& mesh) {
    return {mesh.positions.num_components, mesh.transfer->matrix.num_components, mesh.light_bands(),
            mesh.transfer->num_vertex_components()};
}

}  // namespace

CpuVertices::CpuVertices(std::shared_ptr<const Asset> asset, const DecodeLimits& limits)
    : VertexSource(*asset),
      playback_(std::move(asset)),
      most_(lower_of(limits, all_of(playback_.asset().moving()))) {
    playback_.keep_white_radiance(true);
}

void CpuVertices::write(double time, const DecodeLimits& limits, const LightCoefficients* light,
                        std::span<const Changes> changes, std::span<SurfaceMesh> parts) {
    const auto is_lit = [](const Changes& of) { return of.colors || of.gloss; };
    const auto is_glossy = [](const Changes& of) { return of.gloss; };
    if (std::any_of(changes.begin(), changes.end(), is_lit) && light->values != light_) {
        playback_.set_light(DistantLight(*light));
        light_ = light->values;
    }
    playback_.keep_exit_radiance(std::any_of(changes.begin(), changes.end(), is_glossy));
    playback_.update(time, lower_of(limits, most_));
    for (size_t j = 0; j < parts.size(); ++j) {
        if (changes[j].positions) parts[j].upload_positions(playback_.local_positions(j));
        if (changes[j].gloss) parts[j].gloss()->upload(playback_.exit_radiance(j));
        if (!changes[j].colors) continue;
        parts[j].upload_colors(playback_.radiance(j));
        if (parts[j].has_white_radiance()) {
            parts[j].upload_white_radiance(playback_.white_radiance(j));
        }
    }
}

}  // namespace paim::player
