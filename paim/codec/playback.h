// Plays an asset on the CPU: a light and a time in, positions and radiance out.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "paim/base/export.h"
#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/light/light.h"

namespace paim {

// Owns its scratch memory: one a thread; any number may share an asset. update() does only what is
// needed: nothing if neither time, limits nor light changed; the light alone if the pose is the same.
class PAIM_EXPORT Playback {
  public:
    // asset  with at least one part (checked), as read_paim() returns it
    explicit Playback(std::shared_ptr<const Asset> asset);
    ~Playback();
    Playback(Playback&&) noexcept;
    Playback& operator=(Playback&&) noexcept;

    const Asset& asset() const;
    size_t num_parts() const;

    // Lights all parts from the next update() on. The field is asked at the centre of each part's mean
    // positions, for as many bands as the part has; it is not kept.
    void set_light(const LightField& light);

    // Rebuilds what is shown at `time` in poses: 0 … P−1, clamped; fractions lie between two poses.
    void update(double time, const DecodeLimits& limits = {});

    // Results of the last update(), valid until the next one.
    // returns  [3][V]: all x, then all y, then all z, scene units
    std::span<const float> positions(size_t part = 0) const;
    // returns  [V] linear RGB; empty if no light was set
    std::span<const Vec3f> radiance(size_t part = 0) const;

  private:
    struct Part;
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace paim
