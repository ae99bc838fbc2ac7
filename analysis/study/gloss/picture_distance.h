// Sums over pictures that studies compare.
#pragma once

#include "paim/image/image.h"

namespace paim::study {

// Σ |pixel|².
inline double squared_sum(const Image& image) {
    double sum = 0.0;
    for (const Vec3f& pixel : image.pixels) sum += pixel.cast<double>().squaredNorm();
    return sum;
}

// Which pixels are compared: those that the reference lights, or those that both pictures light.
enum class LitBy { reference, both };

// Σ |image − reference|².
inline double squared_distance(const Image& image, const Image& reference, LitBy lit) {
    double sum = 0.0;
    for (size_t j = 0; j < image.pixels.size(); ++j) {
        if (reference.pixels[j].isZero(0.0f)) continue;
        if (lit == LitBy::both && image.pixels[j].isZero(0.0f)) continue;
        sum += (image.pixels[j] - reference.pixels[j]).cast<double>().squaredNorm();
    }
    return sum;
}

}  // namespace paim::study
