// Coefficients of zonal functions, which are symmetric about an axis.
#pragma once

#include <span>
#include <vector>

#include "paim/base/vector.h"

namespace paim::sh {

// Rotates zonal coefficients (about +z, one a band, m = 0) to another axis:
// c_lm = sqrt(4π / (2l+1)) · zonal_l · y_lm(axis).
// returns [bands²] for bands = zonal.size(); axis unit
std::vector<double> zonal_to_axis(std::span<const double> zonal, const Vec3d& axis);

// Zonal coefficients of the function that is 1 within half_angle_rad of +z and 0 elsewhere, in
// closed form.
// half_angle_rad  0 … π
// returns         [bands]
std::vector<double> cone_zonal(int bands, double half_angle_rad);

}  // namespace paim::sh
