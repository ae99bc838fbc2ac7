// Distant light given by a latitude–longitude image.
// Conventions: docs/conventions.md (those of OpenEXR's lat-long maps).
#pragma once

#include <utility>

#include "paim/image/image.h"
#include "paim/light/light.h"

namespace paim {

// Unit direction of image coordinates: u, v in [0, 1], (0, 0) is the upper left corner of the first
// pixel: latitude π/2 − π v, longitude π − 2π u, direction (sin lon cos lat, sin lat, cos lon cos
// lat).
Vec3d direction_from_latlong(double u, double v);

// The inverse, u in [0, 1), v in [0, 1]; direction need not be unit but not zero.
std::pair<double, double> latlong_from_direction(const Vec3d& direction);

// Projects a lat-long map: each pixel is constant over its exact solid angle
// Δlon · (sin lat_top − sin lat_bottom); the basis is taken at the pixel's centre
// (docs/conventions.md). image  RGB linear radiance, finite; any size >= 1x1 bands  1 …
// sh::kMaxBands
LightCoefficients project_latlong(const Image& image, int bands);

class EnvironmentLight : public LightField {
  public:
    // Throws Error(bad input), naming the pixel, if the image is empty, has a value that is not
    // finite, or values below zero that sum to more than 5 % of those above. Smaller ones, which
    // lossy compression leaves round bright lights, are used as they are: clamping them would
    // brighten the map, while in sums over many pixels they cancel the ringing that they belong to.
    explicit EnvironmentLight(Image image);

    const Image& image() const { return image_; }
    // Projects the image again at each call. bands  1 … sh::kMaxBands
    LightCoefficients coefficients(int bands) const;
    LightCoefficients at(const Vec3f& /*place*/, int bands) const override {
        return coefficients(bands);
    }

    // Radiance from a direction (bilinear, wrapping in longitude).
    Vec3f radiance(const Vec3d& direction) const;

  private:
    Image image_;
};

}  // namespace paim
