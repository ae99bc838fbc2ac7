// What has changed since the last frame, and who decodes.
#include "player/render/vertex_source.h"

#include <algorithm>
#include <utility>

#include "paim/base/error.h"
#include "player/gl/context.h"
#include "player/render/cpu_vertices.h"
#include "player/render/shader_vertices.h"

namespace paim::player {

VertexSource::VertexSource(const Asset& asset) : written_(asset.parts.size()) {
    for (const CodedMesh& mesh : asset.parts) {
        stands_still_.push_back(mesh.num_poses() == 1);
        is_glossy_.push_back(mesh.gloss.has_value());
    }
}

void VertexSource::forget_colors() {
    for (Written& written : written_) written.lit.reset();
}

void VertexSource::update(double time, const DecodeLimits& limits, const LightCoefficients* light,
                          bool gloss, std::span<SurfaceMesh> parts) {
    std::vector<Written> wanted = written_;
    std::vector<Changes> changes;
    for (size_t j = 0; j < written_.size(); ++j) {
        const double own_time = stands_still_[j] ? 0.0 : time;
        wanted[j].pose = {own_time, limits.geometry_components};
        if (light != nullptr) wanted[j].lit = {own_time, limits, light->values};
        if (light != nullptr && gloss && is_glossy_[j]) wanted[j].gloss = wanted[j].lit;
        changes.push_back({written_[j].pose != wanted[j].pose, written_[j].lit != wanted[j].lit,
                           written_[j].gloss != wanted[j].gloss});
        // Where writing fails, it is done again the next time.
        if (changes[j].positions) written_[j].pose.reset();
        if (changes[j].colors) written_[j].lit.reset();
        if (changes[j].gloss) written_[j].gloss.reset();
    }
    const auto is_change = [](const Changes& of) { return of.positions || of.colors || of.gloss; };
    if (std::none_of(changes.begin(), changes.end(), is_change)) return;
    write(time, limits, light, changes, parts);
    for (size_t j = 0; j < written_.size(); ++j) {
        parts[j].count_writes(changes[j].positions, changes[j].colors, changes[j].gloss);
    }
    written_ = std::move(wanted);
}

std::unique_ptr<VertexSource> make_vertex_source(const std::shared_ptr<const Asset>& asset,
                                                 const DecodeLimits& limits,
                                                 const DecodeLimits& fewer, Decoder decoder,
                                                 std::string& note) {
    note.clear();
    const auto in_shaders = [&]() -> std::unique_ptr<VertexSource> {
        try {
            return std::make_unique<ShaderVertices>(asset, limits);
        } catch (const Error&) {
            if (fewer == limits) throw;
            return std::make_unique<ShaderVertices>(asset, fewer);
        }
    };
    const bool in_software = decoder == Decoder::automatic && gl::draws_in_software();
    if (decoder == Decoder::cpu || in_software) return std::make_unique<CpuVertices>(asset, limits);
    if (decoder == Decoder::gpu) return in_shaders();
    try {
        return in_shaders();
    } catch (const Error& error) {
        note = error.what();
        return std::make_unique<CpuVertices>(asset, limits);
    }
}

}  // namespace paim::player
