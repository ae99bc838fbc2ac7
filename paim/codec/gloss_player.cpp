// Plays the gloss of a mesh.
#include "paim/codec/gloss_player.h"

#include "paim/shade/exit_radiance.h"

namespace paim {

DecodeLimits limits_of_gloss(const DecodeLimits& limits) {
    DecodeLimits of_gloss = limits;
    of_gloss.transfer_components = limits.gloss_components;
    of_gloss.vertex_components = limits.gloss_vertex_components;
    return of_gloss;
}

GlossPlayer::GlossPlayer(const CodedGloss& gloss)
    : gloss_(gloss), player_(gloss.transfer->make_player(gloss.layout)) {}

void GlossPlayer::light(double time, const DecodeLimits& limits, const LightCoefficients& light) {
    player_->light(time, limits_of_gloss(limits), light, gloss_.tint, exit_);
}

std::span<const Vec3f> GlossPlayer::towards(std::span<const float> positions, const Vec3d& eye) {
    const size_t num_vertices = positions.size() / 3;
    directions_.resize(gloss_.num_rows);
    for (uint32_t r = 0; r < gloss_.num_rows; ++r) {
        const uint32_t v = gloss_.vertex(r);
        const Vec3d position(double{positions[v]}, double{positions[num_vertices + v]},
                             double{positions[2 * num_vertices + v]});
        directions_[r] = (eye - position).stableNormalized().cast<float>();
    }
    radiance_.resize(gloss_.num_rows);
    exit_towards(static_cast<int>(gloss_.layout.out_bands), exit_, directions_, radiance_);
    return radiance_;
}

}  // namespace paim
