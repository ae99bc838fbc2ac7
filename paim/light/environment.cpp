// Directions of lat-long maps, and distant light from such a map.
#include "paim/light/environment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/error.h"

namespace paim {

namespace {

// Largest ratio of negative to positive values of a map. Lossy compression and filters make dark
// rims around bright lights slightly negative (0.5 % in the maps seen so far). A map with more is
// not radiance.
constexpr double kMaxNegativeEnergy = 0.05;

void check_radiance(const Image& image) {
    if (image.width < 1 || image.height < 1) {
        throw_bad_input("environment light: {} x {} pixels, expected at least 1 x 1", image.width,
                        image.height);
    }
    double positive = 0.0;
    double negative = 0.0;
    int worst_x = 0;
    int worst_y = 0;
    float worst = 0.0f;
    for (int y = 0; y < image.height; ++y) {
        const double weight = std::sin(kPi * (y + 0.5) / image.height);  // ∝ solid angle
        for (int x = 0; x < image.width; ++x) {
            for (const float value : image.at(x, y)) {
                if (!std::isfinite(value)) {
                    throw_bad_input("environment light: pixel ({}, {}) is {}, expected finite", x,
                                    y, value);
                }
                (value < 0.0f ? negative : positive) += weight * std::abs(value);
                if (value < worst) {
                    worst = value;
                    worst_x = x;
                    worst_y = y;
                }
            }
        }
    }
    if (negative > kMaxNegativeEnergy * positive) {
        throw_bad_input(
            "environment light: pixel ({}, {}) is {}, and values below zero sum to {:.2g} of those "
            "above; expected at most {}",
            worst_x, worst_y, worst, negative / positive, kMaxNegativeEnergy);
    }
}

}  // namespace

Vec3d direction_from_latlong(double u, double v) {
    const double latitude = kPi * (0.5 - v);
    const double longitude = kPi * (1.0 - 2.0 * u);
    return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
            std::cos(longitude) * std::cos(latitude)};
}

std::pair<double, double> latlong_from_direction(const Vec3d& direction) {
    const double longitude = std::atan2(direction.x(), direction.z());
    const double latitude = std::atan2(direction.y(), std::hypot(direction.x(), direction.z()));
    const double u = 0.5 - 0.5 * longitude / kPi;
    // −π and π are one meridian; tiny negative longitudes may round u up to 1.
    return {u < 1.0 ? u : 0.0, std::clamp(0.5 - latitude / kPi, 0.0, 1.0)};
}

EnvironmentLight::EnvironmentLight(Image image) : image_(std::move(image)) {
    check_radiance(image_);
}

LightCoefficients EnvironmentLight::coefficients(int bands) const {
    return project_latlong(image_, bands);
}

Vec3f EnvironmentLight::radiance(const Vec3d& direction) const {
    const auto [u, v] = latlong_from_direction(direction);
    const double x = u * image_.width - 0.5;
    const double y = std::clamp(v * image_.height - 0.5, 0.0, image_.height - 1.0);
    const double x_floor = std::floor(x);
    const double fx = x - x_floor;
    const int y0 = static_cast<int>(y);
    const double fy = y - y0;
    const int x0 = (static_cast<int>(x_floor) + image_.width) % image_.width;
    const int x1 = (x0 + 1) % image_.width;
    const int y1 = std::min(y0 + 1, image_.height - 1);
    const auto row = [&](int j) -> Vec3d {
        return (1.0 - fx) * image_.at(x0, j).cast<double>() + fx * image_.at(x1, j).cast<double>();
    };
    return ((1.0 - fy) * row(y0) + fy * row(y1)).cast<float>();
}

}  // namespace paim
