// The shared camera as OpenGL wants it.
#include "player/render/clip_from_world.h"

#include <glm/gtc/matrix_transform.hpp>

namespace paim::player {

namespace {

glm::vec3 to_glm(const Vec3f& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

glm::mat4 clip_from_world(const Camera& camera, float aspect, const DepthRange& depth,
                          const PictureRegion& region) {
    glm::mat4 clip_from_camera = glm::perspectiveRH_NO(camera.vertical_fov_rad, aspect,
                                                       depth.near_distance, depth.far_distance);
    if (!region.is_whole()) {
        // The region has its centre at 2 · corner + size − 1 of the whole clip space, and its size.
        glm::mat4 region_from_whole(1.0f);
        region_from_whole[0][0] = 1.0f / region.width;
        region_from_whole[1][1] = 1.0f / region.height;
        region_from_whole[3][0] = -(2.0f * region.left + region.width - 1.0f) / region.width;
        region_from_whole[3][1] = -(2.0f * region.bottom + region.height - 1.0f) / region.height;
        clip_from_camera = region_from_whole * clip_from_camera;
    }
    const glm::mat4 camera_from_world =
        glm::lookAtRH(to_glm(camera.eye), to_glm(camera.target), to_glm(camera.up));
    return clip_from_camera * camera_from_world;
}

}  // namespace paim::player
