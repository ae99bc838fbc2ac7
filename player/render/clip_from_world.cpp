// The shared camera as OpenGL wants it.
#include "player/render/clip_from_world.h"

#include <glm/gtc/matrix_transform.hpp>

namespace paim::player {

namespace {

glm::vec3 to_glm(const Vec3f& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

glm::mat4 clip_from_world(const Camera& camera, float aspect, const DepthRange& depth) {
    const glm::mat4 clip_from_camera = glm::perspectiveRH_NO(
        camera.vertical_fov_rad, aspect, depth.near_distance, depth.far_distance);
    const glm::mat4 camera_from_world =
        glm::lookAtRH(to_glm(camera.eye), to_glm(camera.target), to_glm(camera.up));
    return clip_from_camera * camera_from_world;
}

}  // namespace paim::player
