// How much of the light that arrives a BRDF reflects.
#include "compressor/material/reflectance.h"

#include <vector>

#include "compressor/material/lobe_quadrature.h"

namespace paim {

double normal_reflectance(const Brdf& brdf) {
    std::vector<LobeQuadrature::Point> points;
    LobeQuadrature(brdf).points(1.0, points);
    double sum = 0.0;
    for (const auto& [direction, value, weight] : points) sum += weight * value * direction.z();
    return sum;
}

}  // namespace paim
