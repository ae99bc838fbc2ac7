// The shared camera as OpenGL wants it.
#pragma once

#include <glm/mat4x4.hpp>

#include "paim/shade/camera.h"
#include "player/render/depth_range.h"
#include "player/render/frame.h"

namespace paim::player {

// World to OpenGL's clip space (z from −1 to 1): the same picture as Camera::ray_direction() sees.
// aspect  width / height of the picture
// region  of the picture, which fills the clip space
glm::mat4 clip_from_world(const Camera& camera, float aspect, const DepthRange& depth,
                          const PictureRegion& region = {});

}  // namespace paim::player
