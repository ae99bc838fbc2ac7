// A second light that is added to an environment: a disc of constant radiance, infinitely far away.
// Based on: Ramamoorthi and Hanrahan, On the Relationship between Radiance and Irradiance, 2001
//           (coefficients of functions about an axis); paim/sh/zonal.h has the closed form of a cap
#pragma once

#include "paim/image/image.h"
#include "paim/light/light.h"

namespace paim::player {

struct KeyLight {
    static constexpr double kMinDiameter_deg = 0.5;  // as the sun has
    static constexpr double kMaxDiameter_deg = 180.0;

    // Where the light is, as for the camera: azimuth about +Y of the scene, 0 is +Z, 90 is +X;
    // elevation above the horizon. It does not turn with the environment.
    double azimuth_deg = 0.0;
    double elevation_deg = 45.0;
    Vec3f color = Vec3f::Ones();  // linear RGB, finite, at least 0
    // Irradiance of a surface that faces the light, for the colour (1, 1, 1): at least 0. An open
    // surface of albedo 1 then has the radiance strength / π. So the size changes how soft shadows
    // are, but not how bright such a surface is.
    double strength = 1.0;
    double angular_diameter_deg = 10.0;  // kMinDiameter_deg … kMaxDiameter_deg

    bool operator==(const KeyLight&) const = default;

    Vec3d direction() const;  // towards the light, unit

    // Radiance of the disc, linear RGB. An angular radius of α gives color · strength / (π sin² α).
    Vec3d disc_radiance() const;

    // Whether light from this direction comes from the disc.
    // direction  unit
    bool covers(const Vec3d& direction_to_light) const;

    // In closed form. The diameter is checked.
    // bands  1 … sh::kMaxBands
    LightCoefficients coefficients(int bands) const;
};

}  // namespace paim::player
