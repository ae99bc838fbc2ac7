// Plays the gloss of a mesh: light first, then the direction of the view.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/codec/gloss_frames.h"
#include "paim/codec/transfer_player.h"
#include "paim/light/light.h"

namespace paim {

// The limits of the gloss as those of a transfer.
DecodeLimits limits_of_gloss(const DecodeLimits& limits);

class GlossPlayer {
  public:
    // Keeps a reference to the mesh, which has gloss (checked).
    explicit GlossPlayer(const CodedMesh& mesh);

    // Places the rows: their frames and the directions towards an eye come from their positions. Before
    // light().
    // positions  [3][V] of the mesh, in local axes
    void place(std::span<const float> positions);

    // Outgoing coefficients of all rows, with their tints.
    // light  in local axes
    void light(double time, const DecodeLimits& limits, const LightCoefficients& light);
    // [out_bands²][R] Of the last call, of directions in local axes.
    std::span<const Vec3f> exit_radiance() const { return exit_; }

    // Radiance towards an eye, of what was lit last.
    // eye      in local axes
    // returns  [R]
    std::span<const Vec3f> towards(const Vec3d& eye);

  private:
    const CodedGloss& gloss_;
    std::unique_ptr<TransferPlayer> player_;
    std::unique_ptr<GlossFrames> frames_;
    std::vector<float> positions_;         // [3][R]
    std::vector<Eigen::Matrix3f> placed_;  // [R]
    std::vector<Vec3f> exit_in_frames_;    // [num_outgoing][R]
    std::vector<Vec3f> exit_;
    std::vector<Vec3f> directions_;  // [R]
    std::vector<Vec3f> radiance_;    // [R]
};

}  // namespace paim
