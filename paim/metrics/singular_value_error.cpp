// The error of dropping components, from singular values alone.
#include "paim/metrics/singular_value_error.h"

#include <cmath>
#include <utility>
#include <vector>

namespace paim {

namespace {

// Σ s^power of the singular values that are not kept, relative to the sum of all. The smallest are
// added first. Values are divided by the largest one, so that powers neither overflow nor
// underflow.
template <typename IsKept, typename Power>
double dropped_sum(std::span<const double> singular_values, const IsKept& is_kept,
                   const Power& power) {
    double sum = 0.0;
    for (size_t k = singular_values.size(); k-- > 0;) {
        if (!is_kept(k)) sum += power(singular_values[k] / singular_values[0]);
    }
    return sum;
}

template <typename IsKept, typename Power>
double dropped_share(std::span<const double> singular_values, const IsKept& is_kept,
                     const Power& power) {
    if (singular_values.empty() || singular_values[0] == 0.0) return 0.0;
    const auto nothing = [](size_t) { return false; };
    return dropped_sum(singular_values, is_kept, power) /
           dropped_sum(singular_values, nothing, power);
}

template <typename IsKept>
double theory_error_of(std::span<const double> singular_values, const IsKept& is_kept) {
    return dropped_share(singular_values, is_kept, [](double s) { return s; });
}

template <typename IsKept>
double energy_error_of(std::span<const double> singular_values, const IsKept& is_kept) {
    return std::sqrt(dropped_share(singular_values, is_kept, [](double s) { return s * s; }));
}

auto first_ones(size_t num_components) {
    return [num_components](size_t k) { return k < num_components; };
}

auto those_of(const LowRank& matrix) {
    std::vector<bool> kept(matrix.singular_values.size(), false);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        PAIM_CHECK_LT(size_t{matrix.singular_index(k)}, kept.size());
        kept[matrix.singular_index(k)] = true;
    }
    return [kept = std::move(kept)](size_t k) { return kept[k]; };
}

}  // namespace

double theory_error(std::span<const double> singular_values, size_t num_components) {
    return theory_error_of(singular_values, first_ones(num_components));
}

double energy_error(std::span<const double> singular_values, size_t num_components) {
    return energy_error_of(singular_values, first_ones(num_components));
}

double theory_error(const LowRank& matrix) {
    return theory_error_of(matrix.singular_values, those_of(matrix));
}

double energy_error(const LowRank& matrix) {
    return energy_error_of(matrix.singular_values, those_of(matrix));
}

}  // namespace paim
