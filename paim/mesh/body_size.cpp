// The middle and the size of a body, which outliers do not change.
#include "paim/mesh/body_size.h"

#include <utility>
#include <vector>

#include "paim/base/median.h"

namespace paim {

Vec3d median_point(std::span<const Vec3d> points) {
    Vec3d result;
    std::vector<double> values(points.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t v = 0; v < points.size(); ++v) values[v] = points[v][axis];
        result[axis] = median(values);
    }
    return result;
}

double size_of(std::span<const Vec3d> points) {
    const Vec3d centre = median_point(points);
    std::vector<double> distances;
    for (const Vec3d& point : points) distances.push_back((point - centre).stableNorm());
    // Of points that are spread evenly in a box, the median lies at a quarter of its diagonal.
    constexpr double kMedians = 4.0;
    return kMedians * median(std::move(distances));
}

}  // namespace paim
