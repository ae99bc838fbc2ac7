// Points as planes.
#include "paim/mesh/planes.h"

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

std::vector<Vec3f> from_planes(std::span<const float> planes) {
    PAIM_CHECK_EQ(planes.size() % 3, size_t{0});
    const size_t count = planes.size() / 3;
    std::vector<Vec3f> points(count);
    for (size_t v = 0; v < count; ++v) {
        points[v] = Vec3f(planes[v], planes[count + v], planes[2 * count + v]);
    }
    return points;
}

}  // namespace paim
