// Light in which paths end.
#pragma once

#include <optional>

#include "analysis/reference/light_sampler.h"
#include "paim/light/light.h"

namespace paim {

class PathLight {
  public:
    virtual ~PathLight() = default;

    // Radiance that arrives from a unit direction.
    virtual Vec3d radiance(const Vec3d& direction) const = 0;

    struct Sample {
        Vec3d direction;  // unit
        Vec3d radiance;
        double density;  // per steradian
    };

    // A direction that is likely where light is. Nothing: directions cannot be drawn from the light.
    // u, v  in [0, 1)
    virtual std::optional<Sample> sample(double u, double v) const = 0;
    // The density of sample(), 0 if it draws nothing.
    virtual double density(const Vec3d& direction) const = 0;
};

// An environment map whose pixels are areas of constant radiance.
class MapLight : public PathLight {
  public:
    explicit MapLight(const EnvironmentLight& map) : sampler_(map) {}

    Vec3d radiance(const Vec3d& direction) const override;
    std::optional<Sample> sample(double u, double v) const override;
    double density(const Vec3d& direction) const override;

  private:
    LightSampler sampler_;
};

// Light of spherical-harmonic coefficients, which may be negative in places.
class BandLight : public PathLight {
  public:
    explicit BandLight(LightCoefficients coefficients) : coefficients_(std::move(coefficients)) {}

    Vec3d radiance(const Vec3d& direction) const override;
    std::optional<Sample> sample(double, double) const override { return std::nullopt; }
    double density(const Vec3d&) const override { return 0.0; }

  private:
    LightCoefficients coefficients_;
};

}  // namespace paim
