// The shared camera as OpenGL wants it.
#include "player/render/clip_from_local.h"

#include <glm/gtc/matrix_transform.hpp>

namespace paim::player {

namespace {

glm::dvec3 to_glm(const Vec3f& v) {
    return {v.x(), v.y(), v.z()};
}

glm::dmat4 world_from_local(const RigidTransform& root) {
    glm::dmat4 matrix(1.0);
    const Eigen::Matrix3d rotation = root.rotation.toRotationMatrix();
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) matrix[column][row] = rotation(row, column);
        matrix[3][column] = root.translation[column];
    }
    return matrix;
}

glm::dmat4 clip_from_camera(const Camera& camera, float aspect, const DepthRange& depth,
                            const PictureRegion& region) {
    const glm::dmat4 whole =
        glm::perspectiveRH_NO(double{camera.vertical_fov_rad}, double{aspect},
                              double{depth.near_distance}, double{depth.far_distance});
    if (region.is_whole()) return whole;
    // The region has its centre at 2 · corner + size − 1 of the whole clip space, and its size.
    glm::dmat4 region_from_whole(1.0);
    const double width = double{region.width}, height = double{region.height};
    region_from_whole[0][0] = 1.0 / width;
    region_from_whole[1][1] = 1.0 / height;
    region_from_whole[3][0] = -(2.0 * double{region.left} + width - 1.0) / width;
    region_from_whole[3][1] = -(2.0 * double{region.bottom} + height - 1.0) / height;
    return region_from_whole * whole;
}

}  // namespace

glm::mat4 clip_from_local(const Camera& camera, float aspect, const DepthRange& depth,
                          const PictureRegion& region, const RigidTransform& root) {
    const glm::dmat4 camera_from_world =
        glm::lookAtRH(to_glm(camera.eye), to_glm(camera.target), to_glm(camera.up));
    return glm::mat4(clip_from_camera(camera, aspect, depth, region) * camera_from_world *
                     world_from_local(root));
}

}  // namespace paim::player
