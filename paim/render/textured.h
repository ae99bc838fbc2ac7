// Colours of images in reference pictures.
// Based on: Homan Igehy, Tracing Ray Differentials, 1999 (the steps between pixels)
#pragma once

#include <span>

#include "paim/image/mip_pyramid.h"
#include "paim/mesh/texture.h"
#include "paim/render/render.h"

namespace paim {

// Sets the pixels that show a face with an image: the colour of the image there, times the factor of
// the image, times the interpolated radiance of a white surface. The image is sampled at the level
// that one pixel covers (MipPyramid::level()), as the player does it; steps between pixels are taken
// within squares of two pixels, as GPUs take them. Other pixels stay as they are.
// visible         what find_visible() found of these positions and this camera
// texture         of the first triangles of the topology; others have no image
// pyramids        of the images
// white_radiance  [V] linear RGB
// image           of the size of `visible`
void draw_texture(const VisiblePoints& visible, const Topology& topology,
                  std::span<const Vec3f> positions, const Camera& camera, const Texture& texture,
                  std::span<const MipPyramid> pyramids, std::span<const Vec3f> white_radiance,
                  Image& image);

}  // namespace paim
