// Distant light given by a latitude–longitude image.
// Conventions: docs/conventions.md (those of OpenEXR's lat-long maps).
#pragma once

#include <memory>
#include <utility>

#include "paim/image/image.h"
#include "paim/light/light.h"

namespace paim {

// Unit direction of image coordinates u, v in [0, 1], where (0, 0) is the upper left corner of the
// first pixel: latitude π/2 − π v, longitude π − 2π u, direction (sin lon cos lat, sin lat, cos lon
// cos lat).
Vec3d direction_from_latlong(double u, double v);

// The inverse of direction_from_latlong(): u in [0, 1), v in [0, 1]. The direction is not zero; it
// need not be unit.
std::pair<double, double> latlong_from_direction(const Vec3d& direction);

// What the pixels of row y of so many rows count, ∝ their solid angle.
double latlong_row_weight(int y, int height);

// Projects a lat-long map: each pixel is constant over its exact solid angle
// Δlon · (sin lat_top − sin lat_bottom); the basis is taken at the pixel's centre
// (docs/conventions.md).
// image  linear RGB radiance, finite; at least 1 x 1 pixels
// bands  1 … sh::kMaxBands
LightCoefficients project_latlong(const Image& image, int bands);

class EnvironmentLight : public LightField {
  public:
    // Throws Error(bad input), naming the pixel, if the image is empty, has a value that is not
    // finite, or negative values that sum to more than 5 % of the positive ones. Smaller negative
    // values, which lossy compression leaves around bright lights, are used as they are: in sums
    // over many pixels they cancel the ringing around the light, and clamping them would brighten
    // the map.
    explicit EnvironmentLight(Image image);

    // Of an image that need not be checked. Colours that Rec. 709 does not have may have values
    // below zero (load_light.h).
    // image  at least 1 x 1 pixels (checked), all finite
    static EnvironmentLight of_checked(Image image);

    // A copy of the light has the same image.
    const Image& image() const { return *image_; }
    bool is_black() const;
    // Projects the image again at each call. bands  1 … sh::kMaxBands
    LightCoefficients coefficients(int bands) const;
    LightCoefficients at(const Vec3f& /*place*/, int bands) const override {
        return coefficients(bands);
    }

    // Radiance from a direction (bilinear, wrapping in longitude).
    Vec3f radiance(const Vec3d& direction) const;

  private:
    explicit EnvironmentLight(std::shared_ptr<const Image> image) : image_(std::move(image)) {}

    std::shared_ptr<const Image> image_;
};

}  // namespace paim
