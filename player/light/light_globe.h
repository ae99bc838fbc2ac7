// Two small pictures of the light: as it is, and as the spherical harmonics have it.
#pragma once

#include <vector>

#include "paim/image/image.h"
#include "paim/light/environment.h"
#include "player/light/light_rig.h"

namespace paim::player {

// Each picture shows a ball in parallel projection, with the camera's axes. A point of the ball has the
// radiance of the light that arrives there from straight above the surface, as the viewer sees the
// near side: a sun behind the camera shines on the middle, one to its right on the right rim, one in
// front of it is on the far side and not seen.
class LightGlobe {
  public:
    static constexpr int kMaxSize = 1024;

    struct Pictures {
        // size × size, linear RGB radiance. The ball touches the edges.
        Image light;           // map and key light, whose disc is drawn at least three pixels wide
        Image reconstruction;  // Σ_i L_i y_i, negative values as 0
        // Share of all directions, those on the far side too, from which a channel of the
        // reconstruction is negative, 0 … 1.
        double negative_share = 0.0;
    };

    // Directions of pixels are kept for the next call of the same size, and the map, averaged down to
    // the size of the pictures, for that of the same map.
    // camera_axes  right, up, backward in the scene (Camera::axes())
    // bands        of the reconstruction, 1 … sh::kMaxBands
    // size         of the pictures in pixels, 1 … kMaxSize (checked)
    // background   of pixels whose centre is outside the ball
    // cost         128 pixels: 2 ms at 10 bands, 40 ms at 64 (two cores)
    Pictures draw(LightRig& rig, const Eigen::Matrix3f& camera_axes, int bands, int size,
                  const Vec3f& background);

  private:
    void set_size(int size);
    void set_map(const EnvironmentLight& environment);

    int size_ = 0;
    std::vector<size_t> pixels_;     // those of the ball
    std::vector<Vec3f> directions_;  // their directions in the camera's axes
    int map_size_ = 0;               // that small_map_ is for
    EnvironmentLight map_{Image(1, 1)};
    EnvironmentLight small_map_{Image(1, 1)};
};

}  // namespace paim::player
