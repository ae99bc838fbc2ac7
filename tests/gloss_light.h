// Radiance that glossy transfer sends out, slowly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/base/check.h"
#include "paim/sh/basis.h"
#include "paim/transfer/layout.h"

namespace paim {

// Σ_o y_o(v) Σ_i T_oi L_i of row r in one channel.
// planes  [planes][num_rows]
// light   [in_bands²]
inline double gloss_radiance(const TransferLayout& layout, std::span<const float> planes, size_t r,
                             std::span<const double> light, const Vec3d& v, uint32_t channel = 0) {
    PAIM_CHECK_EQ(light.size(), size_t{layout.num_coefficients()});
    const size_t num_rows = planes.size() / layout.num_planes();
    std::vector<double> basis(layout.num_outgoing());
    sh::evaluate_basis(static_cast<int>(layout.out_bands), v, std::span(basis));
    double radiance = 0.0;
    for (uint32_t o = 0; o < layout.num_outgoing(); ++o) {
        for (uint32_t i = 0; i < layout.num_coefficients(); ++i) {
            radiance += basis[o] * light[i] *
                        static_cast<double>(planes[layout.plane(channel, i, o) * num_rows + r]);
        }
    }
    return radiance;
}

}  // namespace paim
