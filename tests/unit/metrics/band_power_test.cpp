// Weights of bands: by definition, by law, and of a map.
#include "paim/metrics/band_power.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/image/exr.h"
#include "paim/light/environment.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

TEST(BandPower, FlatEndsWithTheBake) {
    const BandPower flat = parse_band_power("flat", 5);
    EXPECT_EQ(flat.name, "flat");
    for (uint32_t l = 0; l < 5; ++l) EXPECT_EQ(flat.weight(l), 1.0) << l;
    EXPECT_EQ(flat.weight(5), 0.0);
    EXPECT_EQ(flat.weight(1'000'000), 0.0);
}

TEST(BandPower, NaturalFallsWithTheSquare) {
    const BandPower natural = parse_band_power("natural", 5);
    EXPECT_EQ(natural.name, "natural");
    for (const uint32_t l : {0u, 1u, 4u, 5u, 99u}) {
        EXPECT_NEAR(natural.weight(l) * (l + 1.0) * (l + 1.0), 1.0, 1e-15) << l;
    }
}

class MapBandPower : public testing::Test {
  protected:
    // Writes c + a · direction, channel by channel.
    std::string write_map(const Vec3f& constant, const Vec3f& slope) const {
        Image image(256, 128);
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const Vec3d d = direction_from_latlong((x + 0.5) / 256, (y + 0.5) / 128);
                image.at(x, y) =
                    constant + slope.cwiseProduct(Vec3f::Constant(static_cast<float>(d.y())));
            }
        }
        write_exr(directory_ / "map.exr", image);
        return (directory_ / "map.exr").string();
    }

    void expect_failure(const std::string& text, ExitCode code, const std::string& part) const {
        try {
            parse_band_power(text, 5);
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << error.what();
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    }

    TemporaryDirectory directory_;
};

// c in band 0 has the coefficient c √(4π); a y in band 1 has a √(4π/3), one of three.
TEST_F(MapBandPower, IsItsMeanSquareCoefficientPerBand) {
    const BandPower spectrum = parse_band_power(write_map(Vec3f(1, 2, 2), Vec3f(0.9f, 0, 1.2f)), 5);
    EXPECT_EQ(spectrum.name, "map.exr");
    EXPECT_EQ(spectrum.weight(0), 1.0);
    // Pixels of π/128 are taken as constant: (π/128)² of a value at most.
    EXPECT_NEAR(spectrum.weight(1) / ((0.81 + 1.44) / 9.0 / 9.0), 1.0, 1e-3);
    for (uint32_t l = 2; l < 64; ++l) EXPECT_LT(spectrum.weight(l), 1e-6) << l;
    EXPECT_EQ(spectrum.weight(64), 0.0);
}

TEST_F(MapBandPower, RefusesWhatIsNoLight) {
    expect_failure("naturl", ExitCode::usage,
                   "expected flat, natural or an OpenEXR file, got 'naturl'");
    expect_failure("", ExitCode::usage, "got ''");
    const std::string missing = (directory_ / "missing.exr").string();
    expect_failure(missing, ExitCode::bad_input, missing);
    expect_failure(write_map(Vec3f::Zero(), Vec3f::Zero()), ExitCode::bad_input,
                   "map.exr: expected light, got a black map");
    expect_failure(write_map(-Vec3f::Ones(), Vec3f::Zero()), ExitCode::bad_input, "map.exr: ");
}

}  // namespace
}  // namespace paim
