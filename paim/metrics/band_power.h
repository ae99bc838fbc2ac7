// Band power of light, which weights errors of the transfer.
// Based on: Dror, Willsky and Adelson, Statistical Characterization of Real-World Illumination,
//           2004
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "paim/light/env_mapping.h"

namespace paim {

// Relative variance of the coefficients of a light in each band. Only ratios between bands count.
struct BandPower {
    std::string name;
    std::vector<double> weights;  // of the first bands
    // The power of band l after those is (l + 1)^-decay, or 0 if decay is 0.
    double decay = 0.0;
    // Of the map that it was measured on (load_light.h).
    std::vector<std::string> notes{};

    double weight(uint32_t band) const;

    // 1 in the bands of a bake, 0 beyond. Under random light with this band power, the RMS of
    // radiance errors is the Frobenius norm of transfer errors.
    static BandPower flat(uint32_t bands);

    // (l + 1)^-2, about the average of real light (docs/metrics.md).
    static BandPower natural();
};

// bands  of the bake, 1 … sh::kMaxBands
// text   "flat", "natural", or the path of an environment map (OpenEXR): its own mean square
//        coefficient of each of sh::kMaxBands bands over the channels, 1 in band 0
// mapping  of the map
// Errors: usage if the text is none of these; bad input, naming the file, if the map cannot be
// read as light (light/load_light.h), or has no power in band 0.
BandPower parse_band_power(std::string_view text, uint32_t bands,
                           EnvMapping mapping = EnvMapping::automatic);

}  // namespace paim
