// Bounds of a pose that single vertices far from all others do not move.
#include "paim/mesh/usual_bounds.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace paim {

UsualBounds usual_bounds(std::span<const Vec3d> positions, std::span<const uint32_t> corners,
                         const BoundsD& bounds) {
    constexpr size_t kFewestCorners = 40, kMostCorners = 4000;
    constexpr double kFar = 8.0;
    UsualBounds result{bounds, {}, Vec3d::Zero()};
    if (corners.empty()) return result;
    const size_t step = corners.size() / kMostCorners + 1;
    Vec3d lower, upper;
    std::vector<double> values;
    for (int axis = 0; axis < 3; ++axis) {
        values.clear();
        for (size_t j = 0; j < corners.size(); j += step) {
            values.push_back(positions[corners[j]][axis]);
        }
        const auto quantile = [&](size_t percent) {
            const auto at =
                values.begin() + static_cast<std::ptrdiff_t>(percent * (values.size() - 1) / 100);
            std::nth_element(values.begin(), at, values.end());
            return *at;
        };
        lower[axis] = quantile(5);
        upper[axis] = quantile(95);
        result.median[axis] = quantile(50);
    }
    if (corners.size() < kFewestCorners) return result;
    result.middle.extend(lower);
    result.middle.extend(upper);
    const double diagonal = result.middle.diagonal();
    if (diagonal > 0.0 && bounds.diagonal() > kFar * diagonal) result.bounds = result.middle;
    return result;
}

}  // namespace paim
