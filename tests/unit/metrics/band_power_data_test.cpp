// Photographed light, against the law that stands for it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "paim/metrics/band_power.h"

namespace paim {
namespace {

// Single maps lie up to 40 times below (a clear sky) and 200 times above (small lamps alone), as
// Dror and his co-authors say they do; the geometric mean of the four follows to a factor of 2.
TEST(BandPowerData, NaturalIsTheMeanOfRealMaps) {
    const std::string directory = std::string(PAIM_DATA_DIR) + "/env/";
    double log_sums[32] = {};
    for (const char* name : {"venice", "forest", "night", "studio"}) {
        const BandPower map = parse_band_power(directory + name + ".exr", 5);
        for (uint32_t l = 0; l < 32; ++l) log_sums[l] += 0.25 * std::log(map.weight(l));
    }
    const BandPower natural = BandPower::natural();
    for (uint32_t l = 0; l < 32; ++l) {
        const double mean = std::exp(log_sums[l]) / natural.weight(l);
        EXPECT_GT(mean, 0.5) << l;
        EXPECT_LT(mean, 2.0) << l;
    }
}

}  // namespace
}  // namespace paim
