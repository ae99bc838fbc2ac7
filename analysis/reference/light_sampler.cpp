// Directions in proportion to the light of an environment map.
#include "analysis/reference/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "paim/base/check.h"

namespace paim {

namespace {

double weight_of(const Vec3f& radiance) {
    return static_cast<double>(radiance.cwiseAbs().maxCoeff());
}

// sin latitude of the upper edge of row y.
double sine_of_edge(int y, int height) {
    return std::cos(kPi * y / height);
}

// The interval of a running sum that u · total is in, and where in it, 0 … 1. Intervals of no weight
// are never found.
struct Place {
    int interval;
    double within;
};
Place find_place(std::span<const double> sums, double u) {
    const double wanted = u * sums.back();
    auto after = std::upper_bound(sums.begin(), sums.end(), wanted);
    if (after == sums.end()) after = std::lower_bound(sums.begin(), sums.end(), sums.back());
    const double begin = *(after - 1);
    return {static_cast<int>(after - sums.begin()) - 1,
            std::clamp((wanted - begin) / (*after - begin), 0.0, 1.0)};
}

}  // namespace

LightSampler::LightSampler(const EnvironmentLight& light) : light_(light) {
    const Image& image = light_.image();
    const auto width = static_cast<size_t>(image.width);
    rows_.push_back(0.0);
    for (int y = 0; y < image.height; ++y) {
        const double solid_angle =
            2.0 * kPi / image.width *
            (sine_of_edge(y, image.height) - sine_of_edge(y + 1, image.height));
        double sum = 0.0;
        pixels_.push_back(sum);
        for (size_t x = 0; x < width; ++x) {
            sum += solid_angle * weight_of(image.at(static_cast<int>(x), y));
            pixels_.push_back(sum);
        }
        rows_.push_back(rows_.back() + sum);
    }
    total_ = rows_.back();
}

LightSampler::Sample LightSampler::pixel(int x, int y, const Vec3f& direction) const {
    const Vec3f& radiance = light_.image().at(x, y);
    const double density = is_black() ? 0.0 : weight_of(radiance) / total_;
    return {direction, radiance, static_cast<float>(density)};
}

LightSampler::Sample LightSampler::sample(double u, double v) const {
    PAIM_CHECK(!is_black());
    const Image& image = light_.image();
    const size_t stride = static_cast<size_t>(image.width) + 1;
    const Place row = find_place(rows_, v);
    const Place column = find_place(
        std::span(pixels_).subspan(static_cast<size_t>(row.interval) * stride, stride), u);
    // Uniform over the pixel: in longitude, and in the sine of the latitude.
    const double top = sine_of_edge(row.interval, image.height);
    const double bottom = sine_of_edge(row.interval + 1, image.height);
    const double y = top + row.within * (bottom - top);
    const double longitude = kPi * (1.0 - 2.0 * (column.interval + column.within) / image.width);
    const double radius = std::sqrt(std::max(0.0, 1.0 - y * y));
    const Vec3d direction(radius * std::sin(longitude), y, radius * std::cos(longitude));
    return pixel(column.interval, row.interval, direction.cast<float>());
}

LightSampler::Sample LightSampler::look(const Vec3f& direction) const {
    const Image& image = light_.image();
    const auto [u, v] = latlong_from_direction(direction.cast<double>());
    const int x = std::min(static_cast<int>(u * image.width), image.width - 1);
    const int y = std::min(static_cast<int>(v * image.height), image.height - 1);
    return pixel(x, y, direction);
}

}  // namespace paim
