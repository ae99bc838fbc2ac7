// Plays the gloss of a mesh.
#include "paim/codec/gloss_player.h"

#include "paim/codec/rebuild_planes.h"
#include "paim/mesh/planes.h"
#include "paim/shade/exit_radiance.h"
#include "paim/shade/turn_exit.h"

namespace paim {

DecodeLimits limits_of_gloss(const DecodeLimits& limits) {
    DecodeLimits of_gloss = limits;
    of_gloss.transfer_components = limits.gloss_components;
    of_gloss.vertex_components = limits.gloss_vertex_components;
    return of_gloss;
}

GlossPlayer::GlossPlayer(const CodedMesh& mesh)
    : gloss_(mesh.gloss.value()), player_(gloss_.transfer->make_player(gloss_.layout)) {
    std::vector<float> first_pose;
    PositionDecoder().decode(mesh.positions, 0.0, mesh.positions.num_components, first_pose);
    frames_ = std::make_unique<GlossFrames>(faces_of_gloss(mesh.topology, gloss_.vertices),
                                            planes_at(first_pose, gloss_.vertices),
                                            turn_vectors(gloss_.frame_turns));
}

void GlossPlayer::place(std::span<const float> positions) {
    positions_ = planes_at(positions, gloss_.vertices);
    placed_ = frames_->at(positions_);
}

void GlossPlayer::light(double time, const DecodeLimits& limits, const LightCoefficients& light) {
    player_->light(time, limits_of_gloss(limits), light, gloss_.tint, exit_in_frames_);
    const auto out_bands = static_cast<int>(gloss_.layout.out_bands);
    exit_.resize(static_cast<size_t>(sh::num_coefficients(out_bands)) * gloss_.num_rows);
    turn_exit(out_bands, placed_, exit_in_frames_, exit_);
}

std::span<const Vec3f> GlossPlayer::towards(const Vec3d& eye) {
    const size_t num_rows = gloss_.num_rows;
    directions_.resize(num_rows);
    for (size_t r = 0; r < num_rows; ++r) {
        const Vec3d position(double{positions_[r]}, double{positions_[num_rows + r]},
                             double{positions_[2 * num_rows + r]});
        directions_[r] = (eye - position).stableNormalized().cast<float>();
    }
    radiance_.resize(num_rows);
    exit_towards(static_cast<int>(gloss_.layout.out_bands), exit_, directions_, radiance_);
    return radiance_;
}

}  // namespace paim
