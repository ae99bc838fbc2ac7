// Projects a lat-long map in two steps, because the basis about the map's polar axis +Y is a
// product of functions of longitude and latitude: Fourier sums in longitude of each row, then sums
// of Legendre functions over the rows. The coefficients are then rotated from the polar axis +Y to
// the basis' +Z. The result is Σ pixel · solid angle · y_i(centre) over all pixels, at 2B − 1
// instead of B² products a pixel.
// Based on: Driscoll and Healy, Computing Fourier Transforms and Convolutions on the 2-Sphere, 1994
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/light/environment.h"
#include "paim/sh/basis.h"
#include "paim/sh/rotate.h"

namespace paim {

namespace {

// cos m lon and sin m lon of every column's centre, [width][bands].
struct Waves {
    std::vector<double> cosine;
    std::vector<double> sine;
};

Waves longitude_waves(int width, int bands) {
    Waves waves;
    for (int x = 0; x < width; ++x) {
        const double longitude = kPi * (1.0 - (2.0 * x + 1.0) / width);
        for (int m = 0; m < bands; ++m) {
            waves.cosine.push_back(std::cos(m * longitude));
            waves.sine.push_back(std::sin(m * longitude));
        }
    }
    return waves;
}

// One row's sums over its pixels, [3][bands] each.
void sum_row(const Vec3f* row, int width, size_t bands, const Waves& waves, double* cosine_sums,
             double* sine_sums) {
    for (size_t x = 0; x < static_cast<size_t>(width); ++x) {
        const double* cosine = waves.cosine.data() + x * bands;
        const double* sine = waves.sine.data() + x * bands;
        for (size_t c = 0; c < 3; ++c) {
            const double value = row[x][static_cast<Eigen::Index>(c)];
            for (size_t m = 0; m < bands; ++m) cosine_sums[c * bands + m] += value * cosine[m];
            for (size_t m = 0; m < bands; ++m) sine_sums[c * bands + m] += value * sine[m];
        }
    }
}

}  // namespace

LightCoefficients project_latlong(const Image& image, int bands) {
    PAIM_CHECK_LE(1, image.width);
    PAIM_CHECK_LE(1, image.height);
    PAIM_CHECK_LE(1, bands);
    PAIM_CHECK_LE(bands, sh::kMaxBands);
    const auto height = static_cast<size_t>(image.height);
    const auto num_bands = static_cast<size_t>(bands);
    const auto num_values = static_cast<size_t>(sh::num_coefficients(bands));
    const size_t stride = 3 * num_bands;

    const Waves waves = longitude_waves(image.width, bands);
    std::vector<double> cosine_sums(height * stride);
    std::vector<double> sine_sums(height * stride);
    parallel_for(height, 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            sum_row(&image.at(0, static_cast<int>(y)), image.width, num_bands, waves,
                    cosine_sums.data() + y * stride, sine_sums.data() + y * stride);
        }
    });

    // Rows in order, so that the result does not depend on threads.
    std::vector<double> polar_y[3];
    for (auto& values : polar_y) values.assign(num_values, 0.0);
    std::vector<double> legendre(num_values);
    for (size_t y = 0; y < height; ++y) {
        const double latitude = kPi * (0.5 - (static_cast<double>(y) + 0.5) / image.height);
        // Δlon (sin lat_top − sin lat_bottom) of a pixel, in a form without cancellation.
        const double solid_angle =
            2.0 * kPi / image.width * 2.0 * std::cos(latitude) * std::sin(0.5 * kPi / image.height);
        // At azimuth 0 the basis functions of m >= 0 equal their Legendre factors.
        sh::evaluate_basis(bands, Vec3d(std::cos(latitude), 0.0, std::sin(latitude)), legendre);
        for (size_t c = 0; c < 3; ++c) {
            const double* cosine = cosine_sums.data() + y * stride + c * num_bands;
            const double* sine = sine_sums.data() + y * stride + c * num_bands;
            for (int l = 0; l < bands; ++l) {
                double* values = polar_y[c].data() + sh::index(l, 0);
                const double* factors = legendre.data() + sh::index(l, 0);
                values[0] += solid_angle * factors[0] * cosine[0];
                for (int m = 1; m <= l; ++m) {
                    values[m] += solid_angle * factors[m] * cosine[m];
                    values[-m] += solid_angle * factors[m] * sine[m];
                }
            }
        }
    }

    // Longitude starts at +Z and grows towards +X, so the axes x, y, z of the sums are Z, X, Y of
    // the map.
    Eigen::Matrix3d map_from_sums;
    map_from_sums << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    const sh::Rotation rotation(bands, map_from_sums);
    LightCoefficients light{bands, std::vector<Vec3f>(num_values)};
    std::vector<double> turned(num_values);
    for (int c = 0; c < 3; ++c) {
        rotation.apply(polar_y[c], turned);
        for (size_t i = 0; i < num_values; ++i) light.values[i][c] = static_cast<float>(turned[i]);
    }
    return light;
}

}  // namespace paim
