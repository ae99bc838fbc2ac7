// The glossy transfer of a vertex that nothing occludes.
#include "compressor/material/open_gloss.h"

#include <cmath>
#include <cstdlib>

#include "paim/base/gauss_legendre.h"
#include "paim/sh/basis.h"

namespace paim {

std::vector<double> open_gloss(const ExitFunctions& functions, int in_bands) {
    const auto num_in = static_cast<size_t>(sh::num_coefficients(in_bands));
    const std::vector<int>& outgoing = functions.coefficients();
    std::vector<double> result(outgoing.size() * num_in, 0.0);
    std::vector<double> basis(num_in);
    // Over the azimuth cos mφ meets cos m'φ: 2π if m = m' = 0, π if m = m' > 0, and otherwise 0.
    // Three nodes a cell integrate a linear function times a polynomial of degree 4.
    const std::vector<QuadratureNode> nodes = gauss_legendre(3, 0.0, 1.0);
    for (int cell = 0; cell < ExitFunctions::kCells; ++cell) {
        for (const auto& [share, weight] : nodes) {
            const double coordinate = (cell + share) / ExitFunctions::kCells;
            const double root = 1.0 - coordinate * coordinate;
            const double cosine = ExitFunctions::cosine_of(coordinate);
            // b_o = cos θ e_o, and d cosine = 4 coordinate root d coordinate.
            const double height = cosine * 4.0 * coordinate * root * weight / ExitFunctions::kCells;
            sh::evaluate_basis(in_bands, {std::sqrt(1.0 - cosine * cosine), 0.0, cosine},
                               std::span(basis));
            for (size_t row = 0; row < outgoing.size(); ++row) {
                const int l = sh::band_of(outgoing[row]);
                const int m = outgoing[row] - sh::index(l, 0);
                const double value =
                    functions.at(l, std::abs(m), cosine) * height * (m == 0 ? 2.0 * kPi : kPi);
                for (int in = std::abs(m); in < in_bands; ++in) {
                    result[row * num_in + static_cast<size_t>(sh::index(in, m))] +=
                        value * basis[static_cast<size_t>(sh::index(in, std::abs(m)))];
                }
            }
        }
    }
    return result;
}

}  // namespace paim
