// The same sequence at the ends of single precision: the same transfer and the same pictures.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Scale : public ToolTest {
  protected:
    // The OBJ files of a folder with every coordinate times 2^exponent, to the last digit.
    std::string scaled(const std::string& folder, int exponent) {
        const std::string name = path(fmt::format("scaled_{}", exponent));
        std::filesystem::create_directory(name);
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            std::ifstream in(entry.path());
            std::ofstream out(name / entry.path().filename());
            for (std::string line; std::getline(in, line);) {
                std::istringstream words(line);
                std::string kind;
                double x = 0.0, y = 0.0, z = 0.0;
                if (words >> kind && kind == "v" && words >> x >> y >> z) {
                    line = fmt::format("v {:.17g} {:.17g} {:.17g}", std::ldexp(x, exponent),
                                       std::ldexp(y, exponent), std::ldexp(z, exponent));
                }
                out << line << '\n';
            }
        }
        return name;
    }
};

TEST_F(Scale, AnalysisRendersTheSameImages) {
    const std::string folder = make_poses("octopus", 2, 1000);
    Contents unscaled;
    // Coordinates of at most 2^2, so that 2^125 is the last that floats hold.
    for (const int exponent : {0, -110, 125}) {
        const std::string bake = path(fmt::format("{}.bake", exponent));
        const std::string output = path(fmt::format("images_{}", exponent));
        expect_success(compress({"bake", scaled(folder, exponent), "-o", bake, "--floor",
                                 "--floor-vertices", "100", "--rays", "16", "--bands", "3"}));
        expect_success(analyze({bake, "-o", output, "--size", "64", "--poses", "1", "--components",
                                "1", "--bands", "2"}));
        const Contents images = contents_of(output + "/images");
        if (exponent == 0) unscaled = images;
        EXPECT_GE(images.size(), 5u);
        // The image of the bake to the byte; of the others only that they are there, for what the encoder
        // rounds may differ.
        EXPECT_EQ(names_of(images), names_of(unscaled));
        EXPECT_TRUE(images.at("reference_0.png") == unscaled.at("reference_0.png")) << exponent;
    }
}

// Decoders add up what may exceed all floats, so readers refuse such files.
TEST_F(Scale, WhatWouldNotBeReadIsNotEncoded) {
    const std::string folder = make_poses("octopus", 3, 1000);
    const std::string bake = path("x.bake"), output = path("x.paim");
    expect_success(compress({"bake", scaled(folder, 125), "-o", bake, "--floor", "--floor-vertices",
                             "100", "--rays", "16", "--bands", "2"}));
    for (const Arguments& more :
         {Arguments{}, Arguments{"--precision", "f16"}, Arguments{"--measure"}}) {
        Arguments arguments{"encode", bake, "-o", output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_failure(compress(arguments), 2,
                       {output + ": positions: means, components and weights decode to numbers of "
                                 "up to ",
                        "expected at most 3.4e+38: scale the poses down"});
        EXPECT_FALSE(std::filesystem::exists(output));
    }
    // A little smaller, the same is written and read.
    const std::string smaller = path("smaller.bake");
    expect_success(compress({"bake", scaled(folder, 123), "-o", smaller, "--floor",
                             "--floor-vertices", "100", "--rays", "16", "--bands", "2"}));
    expect_success(compress({"encode", smaller, "-o", output}));
    expect_success(info({output}));
}

}  // namespace
}  // namespace paim
