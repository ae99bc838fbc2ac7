// Radiance that glossy transfer sends out, slowly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/base/check.h"
#include "paim/sh/basis.h"
#include "paim/transfer/layout.h"

namespace paim {

// Σ_o y_o(v) Σ_i T_oi L_i of row r in one channel. The direction is in the axes of the outgoing side: those
// of the pose, or those of the row's frame.
// planes  [planes][num_rows]
// light   [in_bands²]
inline double gloss_radiance(const TransferLayout& layout, std::span<const float> planes, size_t r,
                             std::span<const double> light, const Vec3d& v, uint32_t channel = 0) {
    PAIM_CHECK_EQ(light.size(), size_t{layout.num_coefficients()});
    const size_t num_rows = planes.size() / layout.num_planes();
    const auto out_bands = static_cast<int>(layout.out_bands);
    std::vector<double> basis(static_cast<size_t>(sh::num_coefficients(out_bands)));
    sh::evaluate_basis(out_bands, v, std::span(basis));
    double radiance = 0.0;
    for (uint32_t o = 0; o < layout.num_outgoing(); ++o) {
        const double y = basis[layout.kind == TransferKind::glossy
                                   ? static_cast<size_t>(sh::even_coefficient(static_cast<int>(o)))
                                   : o];
        for (uint32_t i = 0; i < layout.num_coefficients(); ++i) {
            radiance += y * light[i] *
                        static_cast<double>(planes[layout.plane(channel, i, o) * num_rows + r]);
        }
    }
    return radiance;
}

}  // namespace paim
