// Reference images on the CPU: one primary ray a pixel, vertex radiance interpolated over the
// triangle (Gouraud), as the player's rasteriser does it.
#pragma once

#include <span>
#include <vector>

#include "paim/image/image.h"
#include "paim/mesh/topology.h"
#include "paim/shade/camera.h"

namespace paim {

// Renders one pose under several lights: its geometry is built and hit once.
// positions  [V] scene units
// camera     its eye finite, which frame_bounds() makes it for coordinates below about 2^120
// radiance   [lights][V] linear RGB
// returns    [lights] width × height images, black where the mesh is not
std::vector<Image> render_images(const Topology& topology, std::span<const Vec3f> positions,
                                 std::span<const std::vector<Vec3f>> radiance, const Camera& camera,
                                 int width, int height);

}  // namespace paim
