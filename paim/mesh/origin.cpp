// Chooses the origin of the coordinates of a sequence.
#include "paim/mesh/origin.h"

#include <cmath>

namespace paim {

Vec3d choose_origin(const BoundsD& bounds) {
    constexpr double kDiagonals = 16.0;
    const double diagonal = bounds.diagonal();
    if (!(diagonal > 0.0)) return Vec3d::Zero();
    const Vec3d center = bounds.center();
    if (!(center.stableNorm() > kDiagonals * diagonal)) return Vec3d::Zero();
    const double step = std::ldexp(1.0, std::ilogb(diagonal));
    // Adding 0 turns −0 into 0, so that messages and files show 0.
    return (center / step).array().round().matrix() * step + Vec3d::Zero();
}

}  // namespace paim
