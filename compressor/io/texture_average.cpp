// The average colour of an image within a triangle of its coordinates.
#include "compressor/io/texture_average.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

using Place = Eigen::Vector2d;  // in images

constexpr double kMostDivisions = 8.0;
// Pixels of a level that are this share of a sample's triangle keep colours from beyond it out.
constexpr double kPixelShare = 0.25;

// Counts from a whole number of images near the triangle, so that no digits of its shape are lost.
Vec3d sample(const MipPyramid& image, Place place, float level) {
    place -= place.array().floor().matrix();
    return image.sample(static_cast<float>(place.x()), static_cast<float>(place.y()), level)
        .cast<double>();
}

}  // namespace

TextureAverage average_of(const MipPyramid& image, const std::array<Vec2f, 3>& corners) {
    const DecodedTexture& pixels = image.levels().front();
    const Place size(pixels.width, pixels.height);
    const Place a = corners[0].cast<double>();
    const Place ab = corners[1].cast<double>() - a;
    const Place ac = corners[2].cast<double>() - a;
    const auto length = [&](const Place& edge) { return edge.cwiseProduct(size).norm(); };
    const double longest = std::max({length(ab), length(ac), length(ac - ab)});
    const double divisions = std::clamp(std::ceil(longest), 1.0, kMostDivisions);
    const auto n = static_cast<int>(divisions);
    const double area = 0.5 * std::abs(ab.x() * ac.y() - ab.y() * ac.x());
    const double pixels_a_sample = area * size.x() * size.y() / (divisions * divisions);
    // Half of the logarithm, as a level has a quarter of the pixels of the one before.
    const double level = 0.5 * std::log2(std::max(1.0, kPixelShare * pixels_a_sample));
    Vec3d sum = Vec3d::Zero();
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            // The centroids of a triangle, and of the one that points the other way next to it.
            const auto at = [&](double third) {
                return Place(a + ab * ((i + third) / divisions) + ac * ((j + third) / divisions));
            };
            sum += sample(image, at(1.0 / 3.0), static_cast<float>(level));
            if (i + j + 1 < n) sum += sample(image, at(2.0 / 3.0), static_cast<float>(level));
        }
    }
    return {sum / (divisions * divisions), area};
}

}  // namespace paim
