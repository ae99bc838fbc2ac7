// Averages of pixel blocks.
#include "paim/image/image.h"

namespace paim {

Image downsample(const Image& image, int factor) {
    PAIM_CHECK_LE(1, factor);
    PAIM_CHECK_EQ(image.width % factor, 0);
    PAIM_CHECK_EQ(image.height % factor, 0);
    Image result(image.width / factor, image.height / factor);
    const double weight = 1.0 / (static_cast<double>(factor) * factor);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            Vec3d sum = Vec3d::Zero();
            for (int j = 0; j < factor; ++j) {
                for (int i = 0; i < factor; ++i) {
                    sum += image.at(x * factor + i, y * factor + j).cast<double>();
                }
            }
            result.at(x, y) = (sum * weight).cast<float>();
        }
    }
    return result;
}

}  // namespace paim
