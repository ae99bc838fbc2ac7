// Plays an asset on the CPU: from a light and a time to positions and radiance.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "paim/base/export.h"
#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/light/light.h"

namespace paim {

// A Playback has scratch memory of its own, so each thread needs one; any number may share an
// asset. update() computes only what changed: nothing if time, limits, light and eye are the same,
// the light alone if only the light is new. Where a part has a root motion (mesh/root_motion.h), its
// positions are moved to the scene and the light is turned into its axes.
class PAIM_EXPORT Playback {
  public:
    // asset  with at least one part (checked), as read_paim() returns it
    explicit Playback(std::shared_ptr<const Asset> asset);
    ~Playback();
    Playback(Playback&&) noexcept;
    Playback& operator=(Playback&&) noexcept;

    const Asset& asset() const;
    size_t num_parts() const;

    // Lights all parts from the next update() on. The light of a part is the field at the centre of
    // the mean positions of its faces, where the last update() put it (or the first pose), in as
    // many bands as the part has. The field is not kept: call this again where it differs from place
    // to place.
    void set_light(const LightField& light);

    // Where glossy surfaces are seen from, from the next update on: scene units, relative to the
    // asset's origin. Without an eye, as at first, radiance is that of the diffuse reflection alone.
    void set_eye(const std::optional<Vec3f>& eye);

    // Whether the next updates compute exit_radiance() without an eye, too. Not unless this is called.
    void keep_exit_radiance(bool keep);

    // Whether the next updates keep the radiance of the same surface in white, too, for parts that
    // have a texture: it is multiplied by the colours of images instead of the albedo. Light is
    // computed once for both. Not kept unless this is called.
    void keep_white_radiance(bool keep);

    // Computes positions and radiance at `time` in poses, clamped to 0 … P−1. Fractions lie between
    // poses.
    void update(double time, const DecodeLimits& limits = {});

    // Results of the last update(), valid until the next one.
    // returns  [3][V]: all x, then all y, then all z, scene units
    std::span<const float> positions(size_t part = 0) const;
    // The same before they were moved to the scene: for bodies that travel so far that floats of
    // the scene are too coarse for their shape.
    std::span<const float> local_positions(size_t part = 0) const;
    RigidTransform root(size_t part = 0) const;
    // returns  [V] linear RGB, towards the eye if there is one; empty if no light was set
    std::span<const Vec3f> radiance(size_t part = 0) const;
    // The radiance of the gloss alone, for each row of CodedGloss.
    // returns  [R]; empty without gloss, light or eye
    std::span<const Vec3f> gloss_radiance(size_t part = 0) const;
    // Outgoing coefficients of the gloss, which do not depend on the eye. Directions are in local axes
    // (root()).
    // returns  [out_bands²][R] of CodedGloss::layout; empty without gloss or light, and unless
    //          they are kept or there is an eye
    std::span<const Vec3f> exit_radiance(size_t part = 0) const;
    // The diffuse radiance without its albedo: diffuse(v) = albedo(v) · white_radiance(v).
    // returns  [V] linear RGB; empty if no light was set, if the part has no texture, or if this is
    //          not kept
    std::span<const Vec3f> white_radiance(size_t part = 0) const;

  private:
    struct Part;
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace paim
