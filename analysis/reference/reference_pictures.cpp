// Pictures that errors are measured against.
#include "analysis/reference/reference_pictures.h"

#include <limits>

namespace paim {

namespace {

double sum_of(const Image& image) {
    double sum = 0.0;
    for (const Vec3f& pixel : image.pixels) sum += pixel.cast<double>().cwiseAbs().sum();
    return sum;
}

}  // namespace

void RelativeNoise::add(const ReferencePictures& reference) {
    for (size_t j = 0; j < reference.pictures.size(); ++j) {
        all_[j % all_.size()] += sum_of(reference.pictures[j]);
        if (!reference.noise.empty()) noise_[j % all_.size()] += sum_of(reference.noise[j]);
    }
}

std::vector<double> RelativeNoise::relative() const {
    std::vector<double> relative;
    for (size_t light = 0; light < all_.size(); ++light) {
        relative.push_back(all_[light] > 0.0 ? noise_[light] / all_[light]
                                             : std::numeric_limits<double>::quiet_NaN());
    }
    return relative;
}

}  // namespace paim
