// Lobes to textures.
#include "player/ui/lobe_view.h"

#include "paim/mesh/planes.h"

namespace paim::player {

namespace {

const Vec3f kBehindLobes = Vec3f::Constant(0.1f);  // display values

}  // namespace

LobeView::LobeView(int bands)
    : shape_(bands), topology_{LobeShape::kNumVertices, shape_.triangles()}, surface_(topology_) {}

void LobeView::update(const std::vector<float>& coefficients, const Camera& camera) {
    const Vec3f direction = (camera.eye - camera.target).stableNormalized();
    if (direction == direction_ && coefficients == coefficients_) return;
    shape_.of(coefficients, lobe_);
    surface_.upload_positions(to_planes(lobe_.positions));
    surface_.upload_colors(lobe_.colors);
    direction_ = direction;
    coefficients_ = coefficients;
    draw(camera);
}

void LobeView::draw(const Camera& camera) {
    Frame frame;
    frame.bounds.extend(Vec3f(Vec3f::Constant(-1.0f)));
    frame.bounds.extend(Vec3f(Vec3f::Ones()));
    frame.camera.vertical_fov_rad = camera.vertical_fov_rad;
    frame.camera.up = camera.up;
    frame.camera.target = Vec3f::Zero();
    frame.camera.eye = 3.6f * direction_;
    frame.display = ToneCurve();
    target_.bind();
    gl::clear(kBehindLobes);
    renderer_.draw(surface_, topology_.triangles.size(),
                   SurfacePlace{.num_following = topology_.triangles.size()}, frame, 1.0f);
}

}  // namespace paim::player
