// A function of direction as a small picture in a panel (inspect/lobe.h), seen from where the camera
// stands.
#pragma once

#include <optional>
#include <vector>

#include "player/gl/target.h"
#include "player/inspect/lobe.h"
#include "player/render/surface_mesh.h"
#include "player/render/surface_renderer.h"

namespace paim::player {

class LobeView {
  public:
    // bands  of the functions that can be shown, 1 … sh::kMaxBands
    explicit LobeView(int bands);

    int bands() const { return shape_.bands(); }

    // Draws Σ_i coefficients[i] y_i if it or the camera's direction differs from the last call's.
    // The axes of the function are those of the scene.
    void update(const std::vector<float>& coefficients, const Camera& camera);

    const gl::TextureHandle& texture() const { return target_.color(); }

  private:
    static constexpr int kSize = 256;  // pixels, about two for each that is shown

    void draw(const Camera& camera);

    LobeShape shape_;
    Topology topology_;
    SurfaceMesh surface_;
    SurfaceRenderer renderer_;
    gl::Target target_{kSize, kSize, gl::TargetKind::display};
    Lobe lobe_;
    std::vector<float> coefficients_;
    Vec3f direction_ = Vec3f::Zero();  // of the camera; zero: nothing was drawn
};

}  // namespace paim::player
