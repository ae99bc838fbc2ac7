// A BRDF that the library does not know, of one number: the same radiance in every direction.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "compressor/material/brdfs.h"

namespace paim {

class Lambertian : public Brdf {
  public:
    explicit Lambertian(double albedo) : albedo_(albedo) {}

    std::string text() const override { return fmt::format("lambertian:{}", albedo_); }
    double value(const Vec3d& in, const Vec3d& out) const override {
        return in.z() > 0.0 && out.z() > 0.0 ? albedo_ / kPi : 0.0;
    }
    Vec3d sample(const Vec3d& /*out*/, double u, double v) const override {
        const double radius = std::sqrt(u);
        return {radius * std::cos(2.0 * kPi * v), radius * std::sin(2.0 * kPi * v),
                std::sqrt(1.0 - u)};
    }
    double pdf(const Vec3d& in, const Vec3d& /*out*/) const override {
        return std::max(0.0, in.z()) / kPi;
    }
    double half_width_rad() const override { return 0.5 * kPi; }

  private:
    double albedo_;
};

// Names it, once for all tests of a program.
inline void add_lambertian() {
    [[maybe_unused]] static const bool added = [] {
        add_brdf({"lambertian",
                  {"albedo"},
                  "the same radiance in every direction",
                  [](std::span<const double> numbers) -> std::unique_ptr<Brdf> {
                      return std::make_unique<Lambertian>(
                          brdf_number("albedo", numbers[0], 0.0, 1.0));
                  }});
        return true;
    }();
}

}  // namespace paim
