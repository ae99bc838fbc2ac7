// The coefficients of a cap, turned to its place.
#include "player/light/key_light.h"

#include <cmath>
#include <vector>

#include "paim/base/check.h"
#include "paim/sh/zonal.h"

namespace paim::player {

namespace {

double radius_rad(const KeyLight& light) {
    PAIM_CHECK_LE(KeyLight::kMinDiameter_deg, light.angular_diameter_deg);
    PAIM_CHECK_LE(light.angular_diameter_deg, KeyLight::kMaxDiameter_deg);
    return 0.5 * light.angular_diameter_deg * kPi / 180.0;
}

}  // namespace

Vec3d KeyLight::direction() const {
    const double azimuth = azimuth_deg * kPi / 180.0, elevation = elevation_deg * kPi / 180.0;
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

Vec3d KeyLight::disc_radiance() const {
    const double sine = std::sin(radius_rad(*this));
    return color.cast<double>() * (strength / (kPi * sine * sine));
}

bool KeyLight::covers(const Vec3d& direction_to_light) const {
    // The chord keeps the digits that the cosine of a small angle loses.
    return (direction_to_light - direction()).norm() <= 2.0 * std::sin(0.5 * radius_rad(*this));
}

LightCoefficients KeyLight::coefficients(int bands) const {
    const std::vector<double> zonal = sh::cone_zonal(bands, radius_rad(*this));
    const std::vector<double> cap = sh::zonal_to_axis(zonal, direction());
    const Vec3d radiance = disc_radiance();
    LightCoefficients light{bands, {}};
    light.values.reserve(cap.size());
    for (const double value : cap) light.values.push_back((value * radiance).cast<float>());
    return light;
}

}  // namespace paim::player
