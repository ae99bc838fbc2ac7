// What dropping components costs, from the singular values alone.
#include "paim/metrics/spectrum.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

// Σ s^power of the values from `first`, smallest first, relative to the largest of all so that
// nothing over- or underflows.
template <typename Power>
double tail_sum(std::span<const double> singular_values, size_t first, const Power& power) {
    double sum = 0.0;
    for (size_t k = singular_values.size(); k-- > first;) {
        sum += power(singular_values[k] / singular_values[0]);
    }
    return sum;
}

template <typename Power>
double dropped_share(std::span<const double> singular_values, size_t num_components,
                     const Power& power) {
    if (singular_values.empty() || singular_values[0] == 0.0) return 0.0;
    return tail_sum(singular_values, num_components, power) / tail_sum(singular_values, 0, power);
}

}  // namespace

double theory_error(std::span<const double> singular_values, size_t num_components) {
    return dropped_share(singular_values, num_components, [](double s) { return s; });
}

double energy_error(std::span<const double> singular_values, size_t num_components) {
    return std::sqrt(
        dropped_share(singular_values, num_components, [](double s) { return s * s; }));
}

}  // namespace paim
