// Averaging an image down.
#include "player/render/fit_image.h"

#include <algorithm>

namespace paim::player {

namespace {

// The mean of columns left … right − 1 and rows top … bottom − 1.
Vec3f mean(const Image& image, int left, int right, int top, int bottom) {
    Vec3d sum = Vec3d::Zero();
    for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) sum += image.at(x, y).cast<double>();
    }
    return (sum / ((right - left) * (bottom - top))).cast<float>();
}

}  // namespace

Image fit_image(const Image& image, int max_size) {
    PAIM_CHECK_LE(1, max_size);
    const int n = (std::max(image.width, image.height) + max_size - 1) / max_size;
    if (n <= 1) return image;
    Image fitting((image.width + n - 1) / n, (image.height + n - 1) / n);
    for (int y = 0; y < fitting.height; ++y) {
        for (int x = 0; x < fitting.width; ++x) {
            fitting.at(x, y) = mean(image, x * n, std::min(image.width, (x + 1) * n), y * n,
                                    std::min(image.height, (y + 1) * n));
        }
    }
    return fitting;
}

}  // namespace paim::player
