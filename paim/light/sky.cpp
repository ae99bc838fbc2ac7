// The built-in sky: a few smooth terms chosen by eye from photographs of late afternoons, not a
// model of the atmosphere. Its smallest feature is the disc of the sun, so that small maps can show
// it.
#include "paim/light/sky.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/light/environment.h"

namespace paim {

namespace {

constexpr double kDegree = kPi / 180.0;
// The sun is in front of the scene and to its left, between −X and +Z. It is to the side of the
// default camera, so that shading shows the shape of objects.
constexpr double kSunElevation = 28.0 * kDegree;
constexpr double kSunAzimuth = -50.0 * kDegree;  // from +Z towards +X
// Scales the average radiance (see sky.h), so that light surfaces are well exposed at 0 EV.
constexpr double kBrightness = 0.7;
// The sun is fully bright within the inner radius and dark beyond the outer one. Its radius is ten
// times that of the real sun.
constexpr double kSunInner = 2.0 * kDegree;
constexpr double kSunOuter = 4.0 * kDegree;

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

Vec3d mix(const Vec3d& a, const Vec3d& b, double t) {
    return (1.0 - t) * a + t * b;
}

Vec3d sun_direction() {
    return {std::sin(kSunAzimuth) * std::cos(kSunElevation), std::sin(kSunElevation),
            std::cos(kSunAzimuth) * std::cos(kSunElevation)};
}

// Both directions unit.
Vec3d sky_radiance(const Vec3d& direction, const Vec3d& sun) {
    const Vec3d zenith(0.13, 0.31, 0.78);
    const Vec3d haze(0.66, 0.76, 0.88);
    const Vec3d glow(0.62, 0.26, 0.02);
    const Vec3d halo(0.95, 0.66, 0.34);
    const Vec3d disc(400.0, 315.0, 215.0);
    const Vec3d ground_near(0.17, 0.145, 0.115);
    const Vec3d ground_far(0.30, 0.27, 0.24);

    const double up = direction.y();
    const double angle = std::atan2(direction.cross(sun).norm(), direction.dot(sun));
    // 1 at the horizon below the sun, 0 opposite; 0.5 at the zenith.
    const double side = 0.5 + 0.5 * (direction.x() * sun.x() + direction.z() * sun.z()) /
                                  std::hypot(sun.x(), sun.z());

    const double height = std::max(0.0, up);
    Vec3d sky = mix(haze, zenith, std::pow(height, 0.55));
    sky += glow * std::exp(-height / 0.16) * side * side * side;
    sky += halo *
           (0.55 * std::exp(-angle / (24.0 * kDegree)) + 2.0 * std::exp(-angle / (5.0 * kDegree)));
    sky += disc * (1.0 - smooth_step(kSunInner, kSunOuter, angle));

    const double depth = std::max(0.0, -up);
    Vec3d ground = mix(ground_far, ground_near, std::pow(depth, 0.35));
    ground += 0.3 * glow * std::exp(-depth / 0.2) * side * side;
    // Ground and sky are mixed over two degrees about the horizon.
    return mix(ground, sky, smooth_step(-0.02, 0.015, up));
}

// Average radiance of the pixel, from factor × factor samples weighted by solid angle.
Vec3d average_radiance(int x, int y, const Image& image, int factor, const Vec3d& sun) {
    Vec3d sum = Vec3d::Zero();
    double weights = 0.0;
    for (int j = 0; j < factor; ++j) {
        const double v = (y + (j + 0.5) / factor) / image.height;
        const double weight = std::sin(kPi * v);
        weights += factor * weight;
        for (int i = 0; i < factor; ++i) {
            const double u = (x + (i + 0.5) / factor) / image.width;
            sum += weight * sky_radiance(direction_from_latlong(u, v), sun);
        }
    }
    return kBrightness * sum / weights;
}

}  // namespace

Image make_sky(int height_pixels) {
    PAIM_CHECK_LE(2, height_pixels);
    PAIM_CHECK_LE(height_pixels, 4096);
    Image image(2 * height_pixels, height_pixels);
    // Samples are a third of a degree apart, whatever the size of the map.
    const int factor = std::max(1, (512 + height_pixels - 1) / height_pixels);
    const Vec3d sun = sun_direction();
    parallel_for(static_cast<size_t>(height_pixels), 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            for (int x = 0; x < image.width; ++x) {
                image.at(x, static_cast<int>(y)) =
                    average_radiance(x, static_cast<int>(y), image, factor, sun).cast<float>();
            }
        }
    });
    return image;
}

}  // namespace paim
