// The shared camera as OpenGL wants it.
#pragma once

#include <glm/mat4x4.hpp>

#include "paim/mesh/root_motion.h"
#include "paim/shade/camera.h"
#include "player/render/depth_range.h"
#include "player/render/frame.h"

namespace paim::player {

// Local coordinates of a mesh to OpenGL's clip space (z from −1 to 1): the same picture as
// Camera::ray_direction() sees. Computed in double, so that a body far from the origin does not
// shake as it travels.
// aspect  width / height of the picture
// region  of the picture, which fills the clip space
// root    where the mesh stands in the world
glm::mat4 clip_from_local(const Camera& camera, float aspect, const DepthRange& depth,
                          const PictureRegion& region = {}, const RigidTransform& root = {});

}  // namespace paim::player
