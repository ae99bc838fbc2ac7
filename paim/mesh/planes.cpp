// Points as planes.
#include "paim/mesh/planes.h"

#include <algorithm>
#include <limits>

#include "paim/base/check.h"

namespace paim {

std::vector<float> to_planes(std::span<const Vec3f> points) {
    const size_t count = points.size();
    std::vector<float> planes(3 * count);
    for (size_t v = 0; v < count; ++v) {
        planes[v] = points[v].x();
        planes[count + v] = points[v].y();
        planes[2 * count + v] = points[v].z();
    }
    return planes;
}

std::vector<float> planes_at(std::span<const float> planes, std::span<const uint32_t> points) {
    if (points.empty()) return {planes.begin(), planes.end()};
    const size_t num_points = planes.size() / 3;
    std::vector<float> chosen;
    chosen.reserve(3 * points.size());
    for (size_t axis = 0; axis < 3; ++axis) {
        for (const uint32_t j : points) chosen.push_back(planes[axis * num_points + j]);
    }
    return chosen;
}

std::vector<Vec3f> from_planes(std::span<const float> planes) {
    PAIM_CHECK_EQ(planes.size() % 3, size_t{0});
    const size_t count = planes.size() / 3;
    std::vector<Vec3f> points(count);
    for (size_t v = 0; v < count; ++v) {
        points[v] = Vec3f(planes[v], planes[count + v], planes[2 * count + v]);
    }
    return points;
}

void transform_planes(const Eigen::Matrix3d& rotation, const Vec3d& shift, std::span<float> planes,
                      size_t num_points) {
    PAIM_CHECK_EQ(planes.size() % 3, 0u);
    constexpr double kMost = std::numeric_limits<float>::max();
    const size_t count = planes.size() / 3;
    for (size_t v = 0; v < std::min(num_points, count); ++v) {
        const Vec3d from(double{planes[v]}, double{planes[count + v]},
                         double{planes[2 * count + v]});
        const Vec3d to = rotation * from + shift;
        for (size_t axis = 0; axis < 3; ++axis) {
            planes[axis * count + v] =
                static_cast<float>(std::clamp(to[static_cast<int>(axis)], -kMost, kMost));
        }
    }
}

}  // namespace paim
