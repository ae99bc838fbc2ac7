// The light as two small balls in a panel (light/light_globe.h).
#pragma once

#include <optional>
#include <tuple>

#include "paim/image/tone.h"
#include "player/gl/byte_picture.h"
#include "player/light/light_globe.h"

namespace paim::player {

class GlobeView {
  public:
    static constexpr int kSize = 128;  // pixels

    // Draws the balls again if the light, the camera or the curve have changed.
    void update(LightRig& rig, const Eigen::Matrix3f& camera_axes, int bands,
                const ToneCurve& curve);

    const gl::TextureHandle& light() const { return light_.texture(); }
    const gl::TextureHandle& reconstruction() const { return reconstruction_.texture(); }
    double negative_share() const { return negative_share_; }

  private:
    struct Key {
        uint64_t revision;
        Eigen::Matrix3f axes;
        int bands;
        ToneCurve curve;
        bool operator==(const Key&) const = default;
    };

    LightGlobe globe_;
    gl::BytePicture light_{kSize, kSize}, reconstruction_{kSize, kSize};
    std::optional<Key> drawn_;
    double negative_share_ = 0.0;
};

}  // namespace paim::player
