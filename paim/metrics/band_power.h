// How much light there is in each band: what errors of the transfer are weighted with.
// Based on: Dror, Willsky and Adelson, Statistical Characterization of Real-World Illumination, 2004
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace paim {

// Variance of a light's coefficient in each band, relative: only ratios between bands count.
struct BandPower {
    std::string name;
    std::vector<double> weights;  // of the first bands
    // Bands after those have (l + 1)^-decay; 0: nothing.
    double decay = 0.0;

    double weight(uint32_t band) const;

    // Every coefficient of a bake's bands alike, nothing beyond: unit random SH light, under which
    // the RMS of radiance errors is the Frobenius norm of the transfer's.
    static BandPower flat(uint32_t bands);

    // (l + 1)^-2: real light, on average (docs/metrics.md).
    static BandPower natural();
};

// bands  of the bake, 1 … sh::kMaxBands
// text   "flat", "natural", or the path of a lat-long map (OpenEXR): its own mean square coefficient
//        of each of sh::kMaxBands bands over the channels, 1 in band 0
// Errors: usage if it is none of these; bad input, naming the file, if that cannot be read, is not
// light (light/environment.h) or has none in band 0.
BandPower parse_band_power(std::string_view text, uint32_t bands);

}  // namespace paim
