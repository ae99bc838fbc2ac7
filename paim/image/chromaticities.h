// Colour spaces of linear RGB images, and their conversion to that of Paim, Rec. 709.
// Based on: ITU-R BT.709-6, 2015 (primaries and white); OpenEXR, ImfChromaticities.h and
//           ImfAcesFile.cpp (RGB to XYZ, Bradford adaptation of the white point, XYZ to RGB)
#pragma once

#include <Eigen/Core>

#include <optional>

namespace paim {

// CIE x, y of the light of RGB (1, 0, 0), (0, 1, 0), (0, 0, 1) and (1, 1, 1).
struct Chromaticities {
    Eigen::Vector2d red{0.64, 0.33};
    Eigen::Vector2d green{0.30, 0.60};
    Eigen::Vector2d blue{0.15, 0.06};
    Eigen::Vector2d white{0.3127, 0.3290};
};

// Whether these are those of Rec. 709, but for rounding to three digits.
bool is_rec709(const Chromaticities& chromaticities);

// The matrix from linear RGB of these primaries to linear RGB of Rec. 709. The white point is
// adapted, so that equal values stay equal values; colours that Rec. 709 does not have get values
// below 0. Nothing if the numbers are no colour space: not finite, primaries on one line, or a
// white that positive amounts of the primaries cannot mix.
std::optional<Eigen::Matrix3d> rec709_from(const Chromaticities& chromaticities);

}  // namespace paim
