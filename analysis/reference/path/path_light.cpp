// Light in which paths end.
#include "analysis/reference/path/path_light.h"

#include <vector>

#include "paim/sh/basis.h"

namespace paim {

Vec3d MapLight::radiance(const Vec3d& direction) const {
    return sampler_.look(direction.cast<float>()).radiance.cast<double>();
}

std::optional<PathLight::Sample> MapLight::sample(double u, double v) const {
    if (sampler_.is_black()) return std::nullopt;
    const LightSampler::Sample drawn = sampler_.sample(u, v);
    return Sample{drawn.direction.cast<double>(), drawn.radiance.cast<double>(),
                  static_cast<double>(drawn.density)};
}

double MapLight::density(const Vec3d& direction) const {
    return static_cast<double>(sampler_.look(direction.cast<float>()).density);
}

Vec3d BandLight::radiance(const Vec3d& direction) const {
    std::vector<double> basis(coefficients_.values.size());
    sh::evaluate_basis(coefficients_.bands, direction, std::span(basis));
    Vec3d sum = Vec3d::Zero();
    for (size_t i = 0; i < basis.size(); ++i) {
        sum += basis[i] * coefficients_.values[i].cast<double>();
    }
    return sum;
}

}  // namespace paim
