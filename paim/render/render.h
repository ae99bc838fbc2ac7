// Reference images on the CPU: one primary ray a pixel.
#pragma once

#include <span>
#include <vector>

#include "paim/image/image.h"
#include "paim/mesh/topology.h"
#include "paim/shade/camera.h"
#include "paim/trace/ray_scene.h"

namespace paim {

// What the pixels of a picture show: the nearest triangle, or none (kNoTriangle).
struct VisiblePoints {
    int width = 0, height = 0;
    std::vector<Hit> hits;  // [height · width], row 0 is the top row
};

// positions  [V] scene units
// camera     with a finite eye; that of frame_bounds() is finite for coordinates below about 2^120
VisiblePoints find_visible(const Topology& topology, std::span<const Vec3f> positions,
                           const Camera& camera, int width, int height);

// Interpolates radiance over the triangles (Gouraud), as the player's rasteriser does it.
// radiance  [V] linear RGB
// returns   black where no mesh is
Image interpolate_image(const VisiblePoints& visible, const Topology& topology,
                        std::span<const Vec3f> radiance);

// Renders one pose under several lights. Rays are traced once for all of them.
// radiance   [lights][V] linear RGB
// returns    [lights] images of width × height pixels
std::vector<Image> render_images(const Topology& topology, std::span<const Vec3f> positions,
                                 std::span<const std::vector<Vec3f>> radiance, const Camera& camera,
                                 int width, int height);

}  // namespace paim
