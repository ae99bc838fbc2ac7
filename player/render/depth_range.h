// Near and far planes that hold the mesh and leave the depth buffer as much precision as they can.
#pragma once

#include "paim/mesh/bounds.h"
#include "paim/shade/camera.h"

namespace paim::player {

struct DepthRange {
    float near_distance;
    float far_distance;
};

// 0 < near < far, scene units. Where the camera is inside the bounds, or close to them, near is
// 1/4096 of the far distance: nearer surfaces are cut off.
DepthRange depth_range(const Camera& camera, const Bounds& bounds);

}  // namespace paim::player
