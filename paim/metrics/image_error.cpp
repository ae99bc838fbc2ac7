// Error of an image to a reference.
#include "paim/metrics/image_error.h"

#include <cmath>
#include <limits>

namespace paim {

double ImageError::visual_error() const {
    if (reference_sum > 0.0) return absolute_sum / reference_sum;
    return absolute_sum > 0.0 ? std::numeric_limits<double>::infinity()
                              : std::numeric_limits<double>::quiet_NaN();
}

void ImageError::add(const ImageError& other) {
    absolute_sum += other.absolute_sum;
    reference_sum += other.reference_sum;
    if (other.worst > worst) {
        worst = other.worst;
        worst_x = other.worst_x;
        worst_y = other.worst_y;
    }
}

ImageError compare_images(const Image& image, const Image& reference) {
    PAIM_CHECK_EQ(image.width, reference.width);
    PAIM_CHECK_EQ(image.height, reference.height);
    ImageError error;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Vec3d a = image.at(x, y).cast<double>();
            const Vec3d b = reference.at(x, y).cast<double>();
            const double difference = (a - b).cwiseAbs().maxCoeff();
            error.absolute_sum += (a - b).cwiseAbs().sum();
            error.reference_sum += b.cwiseAbs().sum();
            if (difference > error.worst) {
                error.worst = difference;
                error.worst_x = x;
                error.worst_y = y;
            }
        }
    }
    return error;
}

}  // namespace paim
