// Reflection at microfacets.
// Based on: Cook and Torrance 1982, Walter et al. 2007, Heitz 2014, Schlick 1994 (see the header);
//           Heitz, Sampling the GGX Distribution of Visible Normals, JCGT 7(4), 2018
#include "compressor/material/cook_torrance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace paim {

namespace {

class CookTorrance : public Brdf {
  public:
    CookTorrance(double ks, double roughness)
        : ks_(ks), roughness_(roughness), alpha2_(std::pow(roughness, 4.0)) {}

    std::string text() const override {
        return fmt::format("cook-torrance:{},{}", ks_, roughness_);
    }

    double value(const Vec3d& in, const Vec3d& out) const override {
        if (!(in.z() > 0.0 && out.z() > 0.0)) return 0.0;
        const Vec3d half = (in + out).normalized();
        // G / (4 cos cos) = 1 / (2 (cos_in · root_out + cos_out · root_in)).
        const double masking = 0.5 / (in.z() * root(out.z()) + out.z() * root(in.z()));
        return distribution(half) * masking * fresnel(in.dot(half));
    }

    // By normals of the facets that are visible from `out`.
    Vec3d sample(const Vec3d& out, double u, double v) const override {
        const double alpha = std::sqrt(alpha2_);
        const Vec3d stretched = Vec3d(alpha * out.x(), alpha * out.y(), out.z()).normalized();
        // Heitz's disk, which is warped along the bitangent.
        Vec3d tangent(-stretched.y(), stretched.x(), 0.0);
        tangent = tangent.isZero(1e-12) ? Vec3d(1.0, 0.0, 0.0) : tangent.normalized();
        const Vec3d bitangent = stretched.cross(tangent);
        const double radius = std::sqrt(u);
        const double a = radius * std::cos(2.0 * kPi * v);
        const double side = 0.5 * (1.0 + stretched.z());
        const double b = (1.0 - side) * std::sqrt(std::max(0.0, 1.0 - a * a)) +
                         side * radius * std::sin(2.0 * kPi * v);
        const Vec3d normal =
            a * tangent + b * bitangent + std::sqrt(std::max(0.0, 1.0 - a * a - b * b)) * stretched;
        const Vec3d half =
            Vec3d(alpha * normal.x(), alpha * normal.y(), std::max(0.0, normal.z())).normalized();
        return 2.0 * out.dot(half) * half - out;
    }

    double pdf(const Vec3d& in, const Vec3d& out) const override {
        const Vec3d sum = in + out;
        if (!(out.z() > 0.0 && sum.z() > 0.0)) return 0.0;
        // D G_1(out) / (4 cos θ_out), where G_1 = 2 cos / (cos + root).
        return distribution(sum.normalized()) * 0.5 / (out.z() + root(out.z()));
    }

    // The half vector turns half as far as the direction.
    double half_width_rad() const override {
        const double sine2 = (std::numbers::sqrt2 - 1.0) * alpha2_ / std::max(1e-9, 1.0 - alpha2_);
        return std::min(2.0 * std::asin(std::sqrt(std::min(sine2, 1.0))), 0.5 * kPi);
    }

  private:
    // GGX. 1 + cos² (α² − 1) from the sine, which is exact for narrow lobes.
    double distribution(const Vec3d& half) const {
        const double sine2 = half.x() * half.x() + half.y() * half.y();
        const double c = sine2 + half.z() * half.z() * alpha2_;
        return alpha2_ / (kPi * c * c);
    }

    // √(α² + (1 − α²) cos²), which is cos (1 + 2 Λ).
    double root(double cosine) const {
        return std::sqrt(alpha2_ + (1.0 - alpha2_) * cosine * cosine);
    }

    double fresnel(double cosine) const {
        const double x = 1.0 - std::min(cosine, 1.0);
        return ks_ + (1.0 - ks_) * x * x * x * x * x;
    }

    double ks_, roughness_, alpha2_;
};

std::unique_ptr<Brdf> make_cook_torrance(std::span<const double> numbers) {
    return std::make_unique<CookTorrance>(brdf_number("ks", numbers[0], 0.0, 1.0),
                                          brdf_number("roughness", numbers[1], 0.02, 1.0));
}

}  // namespace

BrdfType cook_torrance() {
    return {"cook-torrance",
            {"ks", "roughness"},
            "GGX microfacets: ks (0 to 1) is the reflectance at normal incidence, roughness (0.02 "
            "to 1) the square root of the width alpha",
            make_cook_torrance};
}

}  // namespace paim
