// Error of an image to a reference.
#include "paim/metrics/image_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace paim {

double ImageError::visual_error() const {
    if (reference_sum > 0.0) return absolute_sum / reference_sum;
    return absolute_sum > 0.0 ? std::numeric_limits<double>::infinity()
                              : std::numeric_limits<double>::quiet_NaN();
}

double ImageError::rmse() const {
    if (num_values == 0) return std::numeric_limits<double>::quiet_NaN();
    return std::sqrt(squared_sum / static_cast<double>(num_values));
}

double ImageError::psnr_db() const {
    const double error = rmse();
    if (error == 0.0) return std::numeric_limits<double>::infinity();
    return 20.0 * std::log10(reference_peak / error);
}

void ImageError::add(const ImageError& other) {
    absolute_sum += other.absolute_sum;
    reference_sum += other.reference_sum;
    squared_sum += other.squared_sum;
    num_values += other.num_values;
    reference_peak = std::max(reference_peak, other.reference_peak);
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
            error.squared_sum += (a - b).squaredNorm();
            if (!a.isZero(0.0) || !b.isZero(0.0)) error.num_values += 3;
            error.reference_peak = std::max(error.reference_peak, b.cwiseAbs().maxCoeff());
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
