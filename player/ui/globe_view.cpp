// Balls to textures.
#include "player/ui/globe_view.h"

#include <array>
#include <vector>

namespace paim::player {

namespace {

const Vec3f kAroundBalls = Vec3f::Constant(0.02f);

void upload(const Image& image, const ToneCurve& curve, const gl::BytePicture& picture) {
    const std::vector<std::array<uint8_t, 3>> bytes = tone_map(image, curve);
    picture.upload({bytes.front().data(), 3 * bytes.size()});
}

}  // namespace

void GlobeView::update(LightRig& rig, const Eigen::Matrix3f& camera_axes, int bands,
                       const ToneCurve& curve) {
    const Key key{rig.revision(), camera_axes, bands, curve};
    if (drawn_ == key) return;
    const LightGlobe::Pictures pictures = globe_.draw(rig, camera_axes, bands, kSize, kAroundBalls);
    upload(pictures.light, curve, light_);
    upload(pictures.reconstruction, curve, reconstruction_);
    negative_share_ = pictures.negative_share;
    drawn_ = key;
}

}  // namespace paim::player
