// Directions of lat-long maps, and distant light from such a map.
#include "paim/light/environment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/error.h"
#include "paim/light/radiance_check.h"

namespace paim {

namespace {

void check_radiance(const Image& image) {
    if (image.width < 1 || image.height < 1) {
        throw_bad_input("environment light: {} x {} pixels, expected at least 1 x 1", image.width,
                        image.height);
    }
    RadianceCheck check;
    for (int y = 0; y < image.height; ++y) {
        check.add(0, y, {&image.at(0, y), static_cast<size_t>(image.width)},
                  latlong_row_weight(y, image.height));
    }
    check.finish();
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

double latlong_row_weight(int y, int height) {
    return std::sin(kPi * (y + 0.5) / height);
}

EnvironmentLight::EnvironmentLight(Image image) {
    check_radiance(image);
    image_ = std::make_shared<const Image>(std::move(image));
}

EnvironmentLight EnvironmentLight::of_checked(Image image) {
    PAIM_CHECK_LE(1, image.width);
    PAIM_CHECK_LE(1, image.height);
    return EnvironmentLight(std::make_shared<const Image>(std::move(image)));
}

LightCoefficients EnvironmentLight::coefficients(int bands) const {
    return project_latlong(*image_, bands);
}

bool EnvironmentLight::is_black() const {
    return std::all_of(image_->pixels.begin(), image_->pixels.end(),
                       [](const Vec3f& pixel) { return pixel.isZero(0.0f); });
}

Vec3f EnvironmentLight::radiance(const Vec3d& direction) const {
    const Image& image = *image_;
    const auto [u, v] = latlong_from_direction(direction);
    const double x = u * image.width - 0.5;
    const double y = std::clamp(v * image.height - 0.5, 0.0, image.height - 1.0);
    const double x_floor = std::floor(x);
    const double fx = x - x_floor;
    const int y0 = static_cast<int>(y);
    const double fy = y - y0;
    const int x0 = (static_cast<int>(x_floor) + image.width) % image.width;
    const int x1 = (x0 + 1) % image.width;
    const int y1 = std::min(y0 + 1, image.height - 1);
    const auto row = [&](int j) -> Vec3d {
        return (1.0 - fx) * image.at(x0, j).cast<double>() + fx * image.at(x1, j).cast<double>();
    };
    return ((1.0 - fy) * row(y0) + fy * row(y1)).cast<float>();
}

}  // namespace paim
