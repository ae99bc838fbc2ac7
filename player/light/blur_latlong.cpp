// A symmetric kernel between rows of pixels, scaled so that it keeps constants and means.
#include "player/light/blur_latlong.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/image/area_average.h"
#include "player/light/enlarge_latlong.h"

namespace paim::player {

namespace {

constexpr double kPixelsPerSigma = 2.0;
constexpr int kMinHeight = 8;
constexpr int kMaxHeight = 64;
constexpr float kNegligible = 1e-5f;  // of the kernel, whose largest value is 1

// The Gaussian between the pixels of a map of 2n × n pixels.
class SphericalGaussian {
  public:
    SphericalGaussian(int height, double sigma_rad) : height_(height), num_offsets_(height + 1) {
        values_.reserve(static_cast<size_t>(height) * static_cast<size_t>(height) *
                        static_cast<size_t>(num_offsets_));
        for (int i = 0; i < height; ++i) {
            for (int j = 0; j < height; ++j) add_rows(i, j, sigma_rad);
        }
        scale();
    }

    // Weights of the pixels of row `from`, by the distance in columns, 0 … n, in a sum for a pixel of
    // row `to`. Those that are negligible are left out at the end.
    std::span<const float> weights(int to, int from) const {
        const std::span<const float> all(values_.data() + offset(to, from),
                                         static_cast<size_t>(num_offsets_));
        const auto end = std::find(all.begin(), all.end(), 0.0f);
        return all.first(static_cast<size_t>(end - all.begin()));
    }

  private:
    size_t offset(int i, int j) const {
        return static_cast<size_t>(i * height_ + j) * static_cast<size_t>(num_offsets_);
    }

    void add_rows(int i, int j, double sigma_rad) {
        const double lat_i = kPi * (0.5 - (i + 0.5) / height_);
        const double lat_j = kPi * (0.5 - (j + 0.5) / height_);
        const double half_lat = std::sin(0.5 * (lat_i - lat_j));
        for (int k = 0; k < num_offsets_; ++k) {
            // Half the chord between the pixels, which has all digits where the angle is small.
            const double half_lon = std::sin(0.5 * kPi * k / height_);
            const double half_chord2 =
                half_lat * half_lat + std::cos(lat_i) * std::cos(lat_j) * half_lon * half_lon;
            const double angle = 2.0 * std::asin(std::min(1.0, std::sqrt(half_chord2)));
            const double ratio = angle / sigma_rad;
            const auto value = static_cast<float>(std::exp(-0.5 * ratio * ratio));
            values_.push_back(value < kNegligible ? 0.0f : value);
        }
    }

    // Finds factors d with d_i Σ_j sum_ij area_j d_j = 1, where sum_ij is the kernel's sum over a row,
    // and multiplies them in.
    void scale() {
        const Eigen::Index n = height_;
        Eigen::MatrixXd sums(n, n);
        Eigen::VectorXd areas(n);
        for (int i = 0; i < height_; ++i) {
            areas[i] = std::cos(kPi * i / height_) - std::cos(kPi * (i + 1) / height_);
            for (int j = 0; j < height_; ++j) {
                double sum = 0.0;
                // Each distance is there on two sides, but for none and half a turn.
                for (int k = 0; k < num_offsets_; ++k) {
                    const bool once = k == 0 || k == height_;
                    sum += (once ? 1.0 : 2.0) *
                           static_cast<double>(values_[offset(i, j) + static_cast<size_t>(k)]);
                }
                sums(i, j) = sum;
            }
        }
        // The error shrinks to half or less each time.
        Eigen::ArrayXd factors = Eigen::ArrayXd::Ones(n);
        for (int iteration = 0; iteration < 50; ++iteration) {
            const Eigen::VectorXd weighted = areas.array() * factors;
            factors = (factors / (sums * weighted).array()).sqrt();
        }
        for (int i = 0; i < height_; ++i) {
            for (int j = 0; j < height_; ++j) {
                const auto factor = static_cast<float>(factors[i] * areas[j] * factors[j]);
                for (int k = 0; k < num_offsets_; ++k) {
                    values_[offset(i, j) + static_cast<size_t>(k)] *= factor;
                }
            }
        }
    }

    int height_;
    int num_offsets_;
    std::vector<float> values_;  // [to][from][distance in columns]
};

// Adds a row of pixels, each weighted by its distance in columns.
void add_blurred(std::span<const Vec3f> from, std::span<const float> weights, std::span<Vec3f> to) {
    const auto width = static_cast<int>(from.size());
    for (int x = 0; x < width; ++x) {
        Vec3f sum = Vec3f::Zero();
        for (int k = 0; k < static_cast<int>(weights.size()); ++k) {
            const int right = x + k < width ? x + k : x + k - width;
            const int left = x - k >= 0 ? x - k : x - k + width;
            const Vec3f& value = from[static_cast<size_t>(right)];
            const bool once = k == 0 || 2 * k == width;
            sum += weights[static_cast<size_t>(k)] *
                   (once ? value : Vec3f(value + from[static_cast<size_t>(left)]));
        }
        to[static_cast<size_t>(x)] += sum;
    }
}

}  // namespace

Image blur_latlong(const Image& map, double sigma_deg) {
    PAIM_CHECK(sigma_deg >= 0.1 && sigma_deg <= 90.0);
    const int height = std::clamp(static_cast<int>(std::ceil(kPixelsPerSigma * 180.0 / sigma_deg)),
                                  kMinHeight, kMaxHeight);
    const int width = 2 * height;
    Image small = fit_latlong(map, width, height);
    if (small.width < width || small.height < height) {
        small = enlarge_latlong(small, width, height);
    }
    const SphericalGaussian gaussian(height, sigma_deg * kPi / 180.0);
    Image blurred(width, height);
    const auto row_of = [&](auto& image, int y) {
        return std::span(&image.at(0, y), static_cast<size_t>(width));
    };
    parallel_for(static_cast<size_t>(height), 1, [&](size_t begin, size_t end) {
        for (auto y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int j = 0; j < height; ++j) {
                add_blurred(row_of(small, j), gaussian.weights(y, j), row_of(blurred, y));
            }
        }
    });
    return enlarge_latlong(blurred, kBlurredWidth, kBlurredHeight);
}

Image smooth_if_small(const Image& map) {
    if (map.width >= kSmoothWidth && map.height >= kSmoothHeight) return map;
    const double pixel_deg = std::max(180.0 / map.height, 360.0 / map.width);
    return blur_latlong(map, std::min(0.4 * pixel_deg, 90.0));
}

}  // namespace paim::player
