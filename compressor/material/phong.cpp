// Phong's reflection, normalised.
// Based on: Lafortune and Willems 1994 (see the header)
#include "compressor/material/phong.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compressor/material/mirror.h"
#include "paim/base/orthonormal_basis.h"

namespace paim {

namespace {

class Phong : public Brdf {
  public:
    Phong(double ks, double n) : ks_(ks), n_(n) {}

    std::string text() const override { return fmt::format("phong:{},{}", ks_, n_); }

    double value(const Vec3d& in, const Vec3d& out) const override {
        if (!(in.z() > 0.0 && out.z() > 0.0)) return 0.0;
        const double cosine = mirrored(in).dot(out);
        if (!(cosine > 0.0)) return 0.0;
        return ks_ * (n_ + 2.0) / (2.0 * kPi) * std::pow(std::min(cosine, 1.0), n_);
    }

    // By the lobe, with the density (n + 1) / 2π · cos^n α.
    Vec3d sample(const Vec3d& out, double u, double v) const override {
        const double cosine = std::pow(u, 1.0 / (n_ + 1.0));
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        const Vec3d axis = mirrored(out);
        Vec3d tangent, bitangent;
        orthonormal_basis(axis, tangent, bitangent);
        return axis * cosine +
               sine * (tangent * std::cos(2.0 * kPi * v) + bitangent * std::sin(2.0 * kPi * v));
    }

    double pdf(const Vec3d& in, const Vec3d& out) const override {
        const double cosine = mirrored(out).dot(in);
        if (!(cosine > 0.0)) return 0.0;
        return (n_ + 1.0) / (2.0 * kPi) * std::pow(std::min(cosine, 1.0), n_);
    }

    double half_width_rad() const override { return std::acos(std::pow(0.5, 1.0 / n_)); }

  private:
    double ks_, n_;
};

std::unique_ptr<Brdf> make_phong(std::span<const double> numbers) {
    return std::make_unique<Phong>(brdf_number("ks", numbers[0], 0.0, 1.0),
                                   brdf_number("n", numbers[1], 1.0, 10000.0));
}

}  // namespace

BrdfType phong() {
    return {"phong",
            {"ks", "n"},
            "normalised Phong: ks (0 to 1) is the share of light that is reflected at normal "
            "incidence, n (1 to 10000) the exponent of the lobe",
            make_phong};
}

}  // namespace paim
