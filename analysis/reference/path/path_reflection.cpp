// What a point of a triangle reflects.
#include "analysis/reference/path/path_reflection.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

// Shares of directions in proportion to the cosine. Where a surface is glossy alone, they bound the
// weight of directions that its lobes seldom draw.
constexpr double kCosineOfBoth = 0.5, kCosineOfGloss = 0.2;

Vec3d cosine_direction(double u, double v) {
    const double radius = std::sqrt(u), angle = 2.0 * kPi * v;
    return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0, 1.0 - u))};
}

}  // namespace

PathReflection::PathReflection(const PathMaterials& materials, const Albedo& albedo,
                               const Triangle& corners, const std::array<float, 3>& weights,
                               const PathKinds& kinds) {
    double glossy = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        const auto weight = static_cast<double>(weights[c]);
        if (kinds.diffuse) diffuse_ += weight * albedo.at(corners[c]).cast<double>();
        const uint16_t material = materials.materials.at(corners[c]);
        if (!kinds.glossy || material == 0 || !(weight > 0.0)) continue;
        const size_t m = material - 1u;
        lobes_[num_lobes_++] = {materials.brdfs[m].get(),
                                weight * materials.materials.glossy[m].tint.cast<double>(), weight};
        glossy += weight;
    }
    const bool is_diffuse = !diffuse_.isZero(0.0);
    if (!is_diffuse && num_lobes_ == 0) return;
    share_of_cosine_ = num_lobes_ == 0 ? 1.0 : is_diffuse ? kCosineOfBoth : kCosineOfGloss;
    for (size_t j = 0; j < num_lobes_; ++j) lobes_[j].share *= (1.0 - share_of_cosine_) / glossy;
}

Vec3d PathReflection::value(const Vec3d& in, const Vec3d& out) const {
    Vec3d sum = diffuse_ / kPi;
    for (size_t j = 0; j < num_lobes_; ++j)
        sum += lobes_[j].brdf->value(in, out) * lobes_[j].factor;
    return sum;
}

Vec3d PathReflection::sample(const Vec3d& out, double u, double v) const {
    if (u < share_of_cosine_ || num_lobes_ == 0) return cosine_direction(u / share_of_cosine_, v);
    u -= share_of_cosine_;
    size_t j = 0;
    while (j + 1 < num_lobes_ && u >= lobes_[j].share) u -= lobes_[j++].share;
    return lobes_[j].brdf->sample(out, std::min(u / lobes_[j].share, 1.0), v);
}

double PathReflection::density(const Vec3d& in, const Vec3d& out) const {
    double sum = share_of_cosine_ * std::max(0.0, in.z()) / kPi;
    for (size_t j = 0; j < num_lobes_; ++j) {
        sum += lobes_[j].share * lobes_[j].brdf->pdf(in, out);
    }
    return sum;
}

}  // namespace paim
