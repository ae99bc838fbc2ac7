// What a bake's bands say of those that it does not have.
#include "paim/metrics/missing_bands.h"

#include <gtest/gtest.h>

#include <vector>

namespace paim {
namespace {

// A (l + ½)^-2 from band 3 on, after bands that are nothing like it.
std::vector<double> jumping(size_t bands, double amplitude) {
    std::vector<double> energy{50.0, 70.0, 20.0};
    for (size_t l = 3; l < bands; ++l) {
        const double degree = static_cast<double>(l) + 0.5;
        energy.push_back(amplitude / (degree * degree));
    }
    energy.resize(bands);
    return energy;
}

TEST(MissingBands, FindTheAmplitudeOfJumps) {
    for (const size_t bands : {4u, 5u, 9u}) {
        EXPECT_NEAR(missing_band_amplitude(jumping(bands, 2.0)), 2.0, 1e-14) << bands;
    }
    // The mean of odd and even bands; of band 4 and later ones alone.
    std::vector<double> energy = jumping(6, 2.0);
    energy[4] *= 1.5;
    EXPECT_NEAR(missing_band_amplitude(energy), 2.5, 1e-14);
    // Bakes that end before: the last band.
    EXPECT_NEAR(missing_band_amplitude(jumping(3, 0.0)), 20.0 * 2.5 * 2.5, 1e-12);
    EXPECT_NEAR(missing_band_amplitude(jumping(2, 0.0)), 70.0 * 1.5 * 1.5, 1e-12);
    EXPECT_NEAR(missing_band_amplitude(std::vector<double>{4.0}), 1.0, 1e-15);
}

TEST(MissingBands, AreSummedUnderTheLight) {
    EXPECT_EQ(missing_band_energy(jumping(5, 2.0), BandPower::flat(5)), 0.0);
    // A light of two more bands.
    const BandPower light{"x", {1, 1, 1, 1, 1, 3, 2}, 0.0};
    const double expected = 2.0 * (3.0 / (5.5 * 5.5) + 2.0 / (6.5 * 6.5));
    EXPECT_NEAR(missing_band_energy(jumping(5, 2.0), light), expected, 1e-14);
}

// Between the integrals of (x + 1)^-4 and of x^-4 from where it begins, since both factors lie
// between these.
TEST(MissingBands, AreBoundedByIntegralsUnderNaturalLight) {
    for (const size_t bands : {5u, 7u, 64u}) {
        const auto b = static_cast<double>(bands);
        const double energy = missing_band_energy(jumping(bands, 1.0), BandPower::natural());
        EXPECT_GT(energy, (1.0 - 1e-5) / (3.0 * (b + 1.0) * (b + 1.0) * (b + 1.0))) << bands;
        EXPECT_LT(energy, 1.0 / (3.0 * (b - 1.0) * (b - 1.0) * (b - 1.0))) << bands;
    }
}

}  // namespace
}  // namespace paim
