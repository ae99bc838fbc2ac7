// Sums over the basis, 16 directions at a time.
#include "player/light/reconstruct_light.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/sh/basis.h"

namespace paim::player {

namespace {

constexpr int kBatch = sh::BatchBasis::kBatch;
using Lanes = Eigen::Array<float, kBatch, 1>;

// values  [bands²][kBatch], scratch
void reconstruct_batch(const sh::BatchBasis& basis, const LightCoefficients& light,
                       std::span<const Vec3f> directions, std::span<Vec3f> radiance,
                       std::vector<float>& values) {
    Lanes x = Lanes::Zero(), y = Lanes::Zero(), z = Lanes::Zero();
    for (size_t j = 0; j < directions.size(); ++j) {
        const auto lane = static_cast<Eigen::Index>(j);
        x[lane] = directions[j].x();
        y[lane] = directions[j].y();
        z[lane] = directions[j].z();
    }
    basis.evaluate(x.data(), y.data(), z.data(), values.data());
    Lanes red = Lanes::Zero(), green = Lanes::Zero(), blue = Lanes::Zero();
    for (size_t i = 0; i < light.values.size(); ++i) {
        const Eigen::Map<const Lanes> of_basis(values.data() + i * kBatch);
        red += light.values[i].x() * of_basis;
        green += light.values[i].y() * of_basis;
        blue += light.values[i].z() * of_basis;
    }
    for (size_t j = 0; j < radiance.size(); ++j) {
        const auto lane = static_cast<Eigen::Index>(j);
        radiance[j] = Vec3f(red[lane], green[lane], blue[lane]);
    }
}

}  // namespace

void reconstruct_light(const LightCoefficients& light, std::span<const Vec3f> directions,
                       std::span<Vec3f> radiance) {
    PAIM_CHECK_EQ(directions.size(), radiance.size());
    PAIM_CHECK_EQ(light.values.size(), static_cast<size_t>(sh::num_coefficients(light.bands)));
    const sh::BatchBasis basis(light.bands);
    parallel_for(directions.size(), 32 * kBatch, [&](size_t begin, size_t end) {
        std::vector<float> values(light.values.size() * kBatch);
        for (size_t first = begin; first < end; first += kBatch) {
            const size_t count = std::min<size_t>(kBatch, end - first);
            reconstruct_batch(basis, light, directions.subspan(first, count),
                              radiance.subspan(first, count), values);
        }
    });
}

double negative_share(const LightCoefficients& light) {
    static const std::vector<Vec3f> directions = equal_area_directions(4096);
    std::vector<Vec3f> radiance(directions.size());
    reconstruct_light(light, directions, radiance);
    const auto negative = std::count_if(radiance.begin(), radiance.end(),
                                        [](const Vec3f& value) { return value.minCoeff() < 0.0f; });
    return static_cast<double>(negative) / static_cast<double>(directions.size());
}

std::vector<Vec3f> equal_area_directions(int count) {
    PAIM_CHECK_LE(1, count);
    const double golden_angle = kPi * (3.0 - std::sqrt(5.0));
    std::vector<Vec3f> directions;
    directions.reserve(static_cast<size_t>(count));
    for (int i = 0; i < count; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / count;
        const double across = std::sqrt(1.0 - z * z);
        const double azimuth = std::remainder(i * golden_angle, 2.0 * kPi);
        directions.push_back(
            Vec3d(across * std::cos(azimuth), across * std::sin(azimuth), z).cast<float>());
    }
    return directions;
}

}  // namespace paim::player
