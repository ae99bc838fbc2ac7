// Levels by area averages, and samples of them.
#include "paim/image/mip_pyramid.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "paim/base/check.h"
#include "paim/image/area_average.h"
#include "paim/image/tone.h"

namespace paim {

namespace {

// row_of  (y, row) writes row y of the large image as linear colours
template <typename RowOf>
Image halved(int width, int height, const RowOf& row_of) {
    AreaAverage average(width, height, std::max(1, width / 2), std::max(1, height / 2),
                        RowArea::equal);
    std::vector<Vec3f> row(static_cast<size_t>(width));
    for (int y = 0; y < height; ++y) {
        row_of(y, row);
        average.add(0, y, row);
    }
    return average.take();
}

Image halved(const DecodedTexture& image) {
    return halved(image.width, image.height, [&](int y, std::span<Vec3f> row) {
        const Rgb8* from = image.pixels.data() + static_cast<size_t>(y) * row.size();
        for (Vec3f& pixel : row) pixel = srgb_to_linear(*from++);
    });
}

Image halved(const Image& image) {
    return halved(image.width, image.height, [&](int y, std::span<Vec3f> row) {
        std::copy_n(&image.at(0, y), row.size(), row.begin());
    });
}

// One axis of a bilinear sample: two neighbours and the share of the second.
struct Neighbors {
    int first, second;
    float share;
};

// place  in turns of the image
Neighbors neighbors(float place, int size) {
    const float wrapped = place - std::floor(place);  // 0..1, and 1 where it rounds up
    const float at = wrapped * static_cast<float>(size) - 0.5f;
    const float below = std::floor(at);
    const int first = static_cast<int>(below);  // −1 … size − 1
    return {(first + size) % size, (first + 1) % size, at - below};
}

Vec3f sample_level(const DecodedTexture& image, float u, float v) {
    const Neighbors x = neighbors(u, image.width);
    const Neighbors y = neighbors(1.0f - (v - std::floor(v)), image.height);
    const auto row = [&](int line) -> Vec3f {
        const Rgb8* pixels =
            image.pixels.data() + static_cast<size_t>(line) * static_cast<size_t>(image.width);
        return (1.0f - x.share) * srgb_to_linear(pixels[x.first]) +
               x.share * srgb_to_linear(pixels[x.second]);
    };
    return (1.0f - y.share) * row(y.first) + y.share * row(y.second);
}

}  // namespace

MipPyramid::MipPyramid(DecodedTexture image) {
    PAIM_CHECK_LE(1, image.width);
    PAIM_CHECK_LE(1, image.height);
    levels_.push_back(std::move(image));
    if (levels_[0].width == 1 && levels_[0].height == 1) return;
    Image linear = halved(levels_[0]);
    for (;;) {
        levels_.push_back({linear.width, linear.height, tone_map(linear, ToneCurve{})});
        if (linear.width == 1 && linear.height == 1) return;
        linear = halved(linear);
    }
}

Vec3f MipPyramid::sample(float u, float v, float level) const {
    const float clamped = std::clamp(level, 0.0f, static_cast<float>(levels_.size() - 1));
    const auto first = static_cast<size_t>(clamped);
    const float share = clamped - static_cast<float>(first);
    const Vec3f near = sample_level(levels_[first], u, v);
    if (share == 0.0f) return near;
    return (1.0f - share) * near + share * sample_level(levels_[first + 1], u, v);
}

float MipPyramid::level(const Vec2f& per_x, const Vec2f& per_y) const {
    const Vec2f size(static_cast<float>(levels_[0].width), static_cast<float>(levels_[0].height));
    const float x = per_x.cwiseProduct(size).norm(), y = per_y.cwiseProduct(size).norm();
    return std::log2(std::max(x, y));
}

}  // namespace paim
