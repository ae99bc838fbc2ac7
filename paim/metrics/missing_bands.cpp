// Estimates the energy of the transfer in bands that a bake does not have.
#include "paim/metrics/missing_bands.h"

#include <algorithm>
#include <cstdint>

#include "paim/base/check.h"

namespace paim {

namespace {

constexpr size_t kFirstOfTail = 3;

// Number of bands that are summed. Under natural light the rest is less than 10⁻⁶ of the energy
// beyond 64 bands.
constexpr uint32_t kNumBandsSummed = 8192;

double degree_squared(size_t l) {
    return (static_cast<double>(l) + 0.5) * (static_cast<double>(l) + 0.5);
}

}  // namespace

double missing_band_amplitude(std::span<const double> energy) {
    PAIM_CHECK_LE(size_t{1}, energy.size());
    const size_t last = energy.size() - 1;
    const size_t first = std::min(last, std::max(kFirstOfTail, last > 0 ? last - 1 : 0));
    double sum = 0.0;
    for (size_t l = first; l <= last; ++l) sum += energy[l] * degree_squared(l);
    return sum / static_cast<double>(last + 1 - first);
}

double missing_band_energy(std::span<const double> energy, const BandPower& spectrum) {
    double sum = 0.0;
    // The smallest terms are added first.
    for (uint32_t l = kNumBandsSummed; l-- > energy.size();) {
        sum += spectrum.weight(l) / degree_squared(l);
    }
    return missing_band_amplitude(energy) * sum;
}

}  // namespace paim
