// Reference images on the CPU: one primary ray a pixel, vertex radiance interpolated over the
// triangle (Gouraud), as the player's rasteriser does it.
#pragma once

#include <span>
#include <vector>

#include "paim/image/image.h"
#include "paim/mesh/topology.h"
#include "paim/shade/camera.h"

namespace paim {

// Renders one pose under several lights. Rays are traced once for all of them.
// positions  [V] scene units
// camera     with a finite eye; that of frame_bounds() is finite for coordinates below about 2^120
// radiance   [lights][V] linear RGB
// returns    [lights] images of width × height pixels, black where no mesh is
std::vector<Image> render_images(const Topology& topology, std::span<const Vec3f> positions,
                                 std::span<const std::vector<Vec3f>> radiance, const Camera& camera,
                                 int width, int height);

}  // namespace paim
