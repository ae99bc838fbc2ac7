// Plays the gloss of a mesh: light first, then the direction of the view.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/codec/transfer_player.h"
#include "paim/light/light.h"

namespace paim {

// The limits of the gloss as those of a transfer.
DecodeLimits limits_of_gloss(const DecodeLimits& limits);

class GlossPlayer {
  public:
    // Keeps a reference to the gloss.
    explicit GlossPlayer(const CodedGloss& gloss);

    // Outgoing coefficients of all rows, with their tints.
    // light  in the axes of the gloss
    void light(double time, const DecodeLimits& limits, const LightCoefficients& light);
    // [num_outgoing][R] Of the last call.
    std::span<const Vec3f> exit_radiance() const { return exit_; }

    // Radiance towards an eye, of what was lit last.
    // positions  [3][V] of the mesh, and the eye, both in the axes of the gloss
    // returns    [R]
    std::span<const Vec3f> towards(std::span<const float> positions, const Vec3d& eye);

  private:
    const CodedGloss& gloss_;
    std::unique_ptr<TransferPlayer> player_;
    std::vector<Vec3f> exit_;
    std::vector<Vec3f> directions_;  // [R]
    std::vector<Vec3f> radiance_;    // [R]
};

}  // namespace paim
