// Conversion of linear RGB to Rec. 709.
// Based on: ITU-R BT.709-6; OpenEXR, ImfAcesFile.cpp (see the header)
#include "paim/image/chromaticities.h"

#include <Eigen/LU>

#include <cmath>

namespace paim {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// Far beyond every colour space in use. Primaries of large positive and negative luminance, which
// cancel in white, would multiply the noise of pixels by as much.
constexpr double kLargestFactor = 100.0;

// X, Y, Z with X + Y + Z = 1.
Vector3d xyz(const Vector2d& xy) {
    return {xy.x(), xy.y(), 1.0 - xy.x() - xy.y()};
}

// X, Y, Z with Y = 1.
Vector3d white_xyz(const Chromaticities& c) {
    return xyz(c.white) / c.white.y();
}

// The light, in XYZ, of each primary at value 1, as columns. Nothing if some amount is not
// positive.
std::optional<Matrix3d> xyz_from_rgb(const Chromaticities& c) {
    Matrix3d primaries;
    primaries << xyz(c.red), xyz(c.green), xyz(c.blue);
    const Vector3d amounts = primaries.inverse() * white_xyz(c);
    // Written so that NaN fails it.
    if (!(amounts.minCoeff() > 0.0) || !amounts.allFinite()) return std::nullopt;
    return primaries * amounts.asDiagonal();
}

}  // namespace

bool is_rec709(const Chromaticities& c) {
    constexpr double kRounding = 1e-3;
    const Chromaticities own;
    const auto same = [](const Vector2d& a, const Vector2d& b) {
        return (a - b).cwiseAbs().maxCoeff() <= kRounding;
    };
    return same(c.red, own.red) && same(c.green, own.green) && same(c.blue, own.blue) &&
           same(c.white, own.white);
}

std::optional<Matrix3d> rec709_from(const Chromaticities& c) {
    const Chromaticities own;
    for (const Vector2d& xy : {c.red, c.green, c.blue, c.white}) {
        if (!xy.allFinite()) return std::nullopt;
    }
    if (!(c.white.y() > 0.0)) return std::nullopt;
    const std::optional<Matrix3d> xyz_from_file = xyz_from_rgb(c);
    if (!xyz_from_file) return std::nullopt;
    Matrix3d cones_from_xyz;  // Bradford
    cones_from_xyz << 0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296;
    const Vector3d gains =
        (cones_from_xyz * white_xyz(own)).cwiseQuotient(Vector3d(cones_from_xyz * white_xyz(c)));
    const Matrix3d matrix = xyz_from_rgb(own)->inverse() * cones_from_xyz.inverse() *
                            gains.asDiagonal() * cones_from_xyz * *xyz_from_file;
    if (!(gains.minCoeff() > 0.0) || !(matrix.cwiseAbs().maxCoeff() <= kLargestFactor)) {
        return std::nullopt;
    }
    return matrix;
}

}  // namespace paim
