// Bands that BRDFs need, against closed forms.
#include "compressor/material/gloss_bands.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compressor/material/brdfs.h"
#include "paim/sh/cosine_lobe.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

TEST(GlossBands, OfALambertianSurfaceAreThoseOfItsCosine) {
    const GlossEnergy energy = gloss_energy(Lambertian(0.5), 4);
    // Outgoing radiance is a constant.
    EXPECT_NEAR(energy.left_out_out[0], 1.0, 1e-12);
    EXPECT_NEAR(energy.left_out_out[1], 0.0, 1e-4);
    // The cosine lobe max(0, z) has the coefficients π λ_l √((2l + 1) / 4π), and the energy 2π/3.
    double rest = 2.0 * kPi / 3.0;
    for (int b = 1; b <= 4; ++b) {
        const double lambda = sh::cosine_lobe(b - 1);
        rest -= kPi * kPi * lambda * lambda * (2.0 * b - 1.0) / (4.0 * kPi);
        EXPECT_NEAR(energy.left_out_in[static_cast<size_t>(b)], rest / (2.0 * kPi / 3.0), 1e-4);
    }
}

TEST(GlossBands, NarrowerLobesNeedMore) {
    uint32_t in = 0, out = 0;
    for (const char* text : {"phong:0.5,1", "phong:0.5,4", "phong:0.5,12"}) {
        const GlossEnergy energy = gloss_energy(*parse_brdf(text), 16);
        const GlossBands bands = choose_gloss_bands(energy, 0.1, 16, 16);
        EXPECT_GE(bands.in, in) << text;
        EXPECT_GE(bands.out, out) << text;
        EXPECT_LE(bands.error_in, 0.1) << text;
        EXPECT_LE(bands.error_out, 0.1) << text;
        // One band fewer is too few.
        const GlossBands fewer = given_gloss_bands(energy, bands.in - 1, bands.out - 1);
        EXPECT_GT(fewer.error_in, 0.1) << text;
        EXPECT_GT(fewer.error_out, 0.1) << text;
        in = bands.in;
        out = bands.out;
    }
    EXPECT_GT(in, 5u);
    EXPECT_GT(out, 5u);
}

// Far from the horizon cos^n α is exp(−n α² / 2), whose coefficients fall as exp(−l² / 2n). So B bands
// leave out exp(−B² / n) of the energy.
TEST(GlossBands, OfANarrowLobeAreGaussian) {
    const GlossEnergy energy = gloss_energy(*parse_brdf("phong:1,400"), 30);
    for (const size_t bands : {10u, 20u, 30u}) {
        const double expected = std::exp(-static_cast<double>(bands * bands) / 400.0);
        // The horizon cuts lobes within their width, 0.05 rad, which has less weight than 0.05.
        EXPECT_NEAR(energy.left_out_in[bands], expected, 0.03) << bands;
        EXPECT_NEAR(energy.left_out_out[bands], expected, 0.03) << bands;
    }
}

TEST(GlossBands, ANoteSaysWhatIsLeftOut) {
    const std::string narrow = "phong:0.5,500", wide = "phong:0.5,2";
    const GlossEnergy energy = gloss_energy(*parse_brdf(narrow), 8);
    const GlossBands bands = choose_gloss_bands(energy);
    EXPECT_EQ(bands.in, kMostChosenInBands);
    EXPECT_EQ(bands.out, kMostChosenOutBands);
    EXPECT_EQ(bands.error_in, energy.left_out_in[kMostChosenInBands]);
    const std::string note = gloss_bands_note(narrow, given_gloss_bands(energy, 8, 6));
    EXPECT_NE(note.find("phong:0.5,500: 8 bands of light leave out 88 % and 6 bands"),
              std::string::npos)
        << note;
    EXPECT_EQ(gloss_bands_note(wide, choose_gloss_bands(gloss_energy(*parse_brdf(wide), 5))), "");
    // Nothing is reflected.
    const GlossBands none = choose_gloss_bands(gloss_energy(*parse_brdf("phong:0,500"), 5));
    EXPECT_EQ(none.in, 1u);
    EXPECT_EQ(none.error_out, 0.0);
}

}  // namespace
}  // namespace paim
