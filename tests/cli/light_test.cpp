// Environment maps in the tools: what paim-info says of them, and analyses in which there is
// nothing to see.
#include <cmath>
#include <sstream>

#include "paim/image/exr.h"
#include "paim/light/environment.h"
#include "tests/cli/tool_test.h"
#include "tests/exr_files.h"

namespace paim {
namespace {

using Json = nlohmann::json;

class LightTools : public ToolTest {
  protected:
    // 1 + y in red, 2 in green, 1 + x in blue; of a lat-long map of this height.
    static Image gradient(int height) {
        Image image(2 * height, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                const Vec3f d = direction_from_latlong((x + 0.5) / image.width, (y + 0.5) / height)
                                    .cast<float>();
                image.at(x, y) = Vec3f(1.0f + d.y(), 2.0f, 1.0f + d.x());
            }
        }
        return image;
    }

    Json coefficients(const std::string& file, const Arguments& more = {}) const {
        Arguments arguments{path(file), "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return parse_object(info(arguments));
    }

    // Analyses the bake under these lights in small pictures.
    ToolResult analyze_under(const std::string& bake, const Arguments& more) const {
        Arguments arguments{bake,          "-o",      path("out"), "--size",  "16", "--components",
                            "1",           "--bands", "2",         "--poses", "2",  "--quiet",
                            "--elevation", "20"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return analyze(arguments);
    }

    // Each row's visual error in a CSV file.
    std::vector<std::string> visual_errors(const std::string& name) const {
        std::istringstream text(text_of("out/" + name));
        std::vector<std::string> errors;
        std::string line;
        std::getline(text, line);
        while (std::getline(text, line)) {
            std::istringstream fields(line);
            std::string field;
            for (int i = 0; i < 6; ++i) std::getline(fields, field, ',');
            errors.push_back(field);
        }
        return errors;
    }
};

TEST_F(LightTools, InfoListsCoefficients) {
    write_exr(path("light.exr"), gradient(64));
    const Json json = coefficients("light.exr");
    EXPECT_EQ(json["kind"], "light");
    EXPECT_EQ(json["width"], 128);
    EXPECT_EQ(json["height"], 64);
    EXPECT_EQ(json["mapping"], "latlong");
    EXPECT_TRUE(json["chromaticities"].is_null());
    EXPECT_EQ(json["bands"], 3);
    ASSERT_EQ(json["coefficients"].size(), 9u);
    // c has √(4π) c in band 0; y and x have √(4π / 3) where the basis has y and x. Pixels of π/64
    // are taken at their centres.
    const double constant = std::sqrt(4.0 * kPi);
    const double slope = std::sqrt(4.0 * kPi / 3.0);
    const auto expect = [&](size_t i, int l, int m, const Vec3d& rgb) {
        const Json& entry = json["coefficients"][i];
        EXPECT_EQ(entry["l"], l);
        EXPECT_EQ(entry["m"], m);
        for (size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(entry["rgb"][c].get<double>(), rgb[static_cast<Eigen::Index>(c)], 2e-3)
                << i << " " << c;
        }
    };
    expect(0, 0, 0, constant * Vec3d(1, 2, 1));
    expect(1, 1, -1, Vec3d(slope, 0, 0));
    expect(2, 1, 0, Vec3d(0, 0, 0));
    expect(3, 1, 1, Vec3d(0, 0, slope));
    expect(8, 2, 2, Vec3d(0, 0, 0));
    EXPECT_EQ(coefficients("light.exr", {"--bands", "64"})["coefficients"].size(), 4096u);

    const ToolResult text = info({path("light.exr"), "--bands", "2"});
    expect_success(text);
    EXPECT_TRUE(contains(text.out, "mapping: latlong\n")) << text.out;
    EXPECT_TRUE(contains(text.out, "  1  -1       2.04")) << text.out;
    EXPECT_FALSE(contains(text.out, "  2  -2")) << text.out;
}

TEST_F(LightTools, InfoSaysHowAMapWasRead) {
    write_exr_with(path("cube.exr"), Image(4, 24, Vec3f(1, 2, 3)), [](Imf::Header& header) {
        mark_as_cube(header);
        mark_as_ap0(header);
        Imf::addWhiteLuminance(header, 100.0f);
    });
    const Json cube = coefficients("cube.exr");
    EXPECT_EQ(cube["mapping"], "cube");
    EXPECT_EQ(cube["mapping_by"], "attribute envmap");
    EXPECT_EQ(cube["width"], 4);
    EXPECT_NEAR(cube["chromaticities"]["blue"][1].get<double>(), -0.077, 1e-6);
    EXPECT_EQ(cube["converted_to_rec709"], true);
    EXPECT_EQ(cube["white_luminance"], 100.0);
    // AP0's (1, 2, 3) in Rec. 709.
    EXPECT_NEAR(cube["mean_radiance"][2].get<double>(), 3.1838, 1e-3);
    const Json as_latlong = coefficients("cube.exr", {"--env-mapping", "latlong"});
    EXPECT_EQ(as_latlong["mapping_by"], "--env-mapping");
    EXPECT_TRUE(contains(as_latlong["notes"][0], "4 x 24 pixels, expected 2:1"));
    const ToolResult text = info({path("cube.exr"), "--env-mapping", "latlong"});
    EXPECT_TRUE(contains(text.out, "note: 4 x 24 pixels")) << text.out;
    expect_failure(info({path("cube.exr"), "--env-mapping", "angular"}), 2,
                   {"cube.exr: expected N x N pixels of an angular map", "4 x 24"});
    expect_failure(info({path("cube.exr"), "--bands", "65"}), 1, {"--bands"});
    expect_failure(info({path("cube.exr"), "--bands", "0"}), 1, {"--bands"});
    expect_failure(info({path("cube.exr"), "--env-mapping", "sphere"}), 1,
                   {"expected one of auto, latlong, cube, angular"});
    expect_failure(info({path("cube.exr"), "--prefixes"}), 1, {"--prefixes"});
    expect_failure(info({path("none.exr"), "--bands", "2"}), 2, {"none.exr: no such file"});
    write("damaged.exr", "nothing");
    expect_failure(info({path("damaged.exr")}), 2, {"damaged.exr: 7 bytes, not an EXR file"});
    expect_failure(info({make_bake("x.bake"), "--bands", "2"}), 1,
                   {"--bands: expected an environment map", "x.bake"});
}

TEST_F(LightTools, ABlackLightIsNoMeasurement) {
    const std::string bake = make_bake("x.bake");
    write_exr(path("black.exr"), Image(8, 4));
    write_exr(path("grey.exr"), Image(8, 4, Vec3f::Ones()));
    const ToolResult result =
        analyze_under(bake, {"--env", path("black.exr"), "--env", path("grey.exr"), "--json"});
    const Json json = parse_object(result);
    EXPECT_TRUE(contains(result.err, "note: light black: the light is black")) << result.err;
    EXPECT_FALSE(contains(result.err, "light grey")) << result.err;
    for (const char* curve : {"geometry_components", "transfer_components", "bands"}) {
        for (const Json& point : json[curve]) {
            EXPECT_TRUE(point["visual_error"]["black"].is_null()) << point;
            EXPECT_TRUE(point["visual_error"]["grey"].is_number()) << point;
            EXPECT_TRUE(point["transfer_error"].is_number()) << point;
        }
        const auto errors = visual_errors(std::string(curve) + ".csv");
        ASSERT_EQ(errors.size(), 2 * json[curve].size());
        for (size_t row = 0; row < errors.size(); ++row) {
            EXPECT_EQ(errors[row] == "nan", row < json[curve].size()) << errors[row];
        }
    }
    EXPECT_GE(json["bands"].size(), 2u);
    const std::string page = text_of("out/index.html");
    EXPECT_TRUE(contains(page, "<td>nothing to see</td>"));
    EXPECT_TRUE(contains(page, "Nothing to see: the light is black"));
}

// Neither is a black light of another shape, nor a mesh that reflects nothing.
TEST_F(LightTools, BlackCubesAndBlackMeshesAreNoMeasurement) {
    make_bake("x.bake");
    write_exr_with(path("cube.exr"), Image(4, 24), mark_as_cube);
    write_exr(path("grey.exr"), Image(8, 4, Vec3f::Ones()));
    expect_success(compress({"bake", path("plates"), "-o", path("dark.bake"), "--rays", "16",
                             "--bands", "3", "--albedo", "0"}));
    const auto expect_nothing = [&](const std::string& name, const std::string& light,
                                    const std::string& why) {
        const ToolResult result =
            analyze_under(path(name), {"--env", path(light + ".exr"), "--json"});
        EXPECT_TRUE(contains(result.err, "note: light " + light + ": " + why)) << result.err;
        const Json json = parse_object(result);
        for (const Json& point : json["transfer_components"]) {
            EXPECT_TRUE(point["visual_error"][light].is_null()) << point;
        }
    };
    expect_nothing("x.bake", "cube", "the light is black");
    expect_nothing("dark.bake", "grey", "the pictures of the bake are black");
}

// A mesh that is seen from its edge covers no pixel.
TEST_F(LightTools, AnEmptyPictureIsNoMeasurement) {
    std::filesystem::create_directory(path("flat"));
    for (int pose = 1; pose <= 3; ++pose) {
        write("flat/f_" + std::to_string(pose) + ".obj",
              "v 0 0 0\nv " + std::to_string(pose) + " 0 0\nv 0 0 1\nf 1 3 2\n");
    }
    expect_success(
        compress({"bake", path("flat"), "-o", path("flat.bake"), "--rays", "16", "--bands", "3"}));
    const ToolResult result = analyze({path("flat.bake"), "-o", path("out"), "--size", "16",
                                       "--elevation", "0", "--azimuth", "0", "--poses", "2",
                                       "--components", "1", "--bands", "2", "--quiet", "--json"});
    const Json json = parse_object(result);
    EXPECT_TRUE(contains(result.err, "note: light sky: the pictures of the bake are black"))
        << result.err;
    for (const Json& point : json["transfer_components"]) {
        EXPECT_TRUE(point["visual_error"]["sky"].is_null()) << point;
        EXPECT_TRUE(point["transfer_error"].is_number()) << point;
    }
    EXPECT_EQ(visual_errors("bands.csv").front(), "nan");
    // Plots that would have no point are not there.
    EXPECT_FALSE(std::filesystem::exists(path("out/bands_bytes.svg")));
    EXPECT_FALSE(contains(text_of("out/index.html"), "bands_bytes.svg"));
}

// The spectrum of a map does not depend on how the map is stored.
TEST_F(LightTools, SpectraOfMapsGoThroughTheSameReader) {
    const std::string bake = make_bake("x.bake");
    write_exr_with(path("cube.exr"), Image(4, 24, Vec3f(1, 1, 1)), mark_as_cube);
    const Arguments encode{
        "encode",        bake, "-o", path("x.paim"), "--max-error", "30%", "--light-spectrum",
        path("cube.exr")};
    expect_success(compress(encode));
    const ToolResult verified =
        analyze({bake, "--verify", path("x.paim"), "--light-spectrum", path("cube.exr")});
    EXPECT_EQ(verified.exit_code, 0) << verified.err;
    Arguments forced = encode;
    forced.insert(forced.end(), {"--env-mapping", "latlong"});
    EXPECT_TRUE(contains(compress(forced).err,
                         "paim-compress: note: " + path("cube.exr") + ": 4 x 24 pixels"));
    expect_failure(compress({"encode", bake, "-o", path("y.paim"), "--env-mapping", "cube"}), 1,
                   {"--env-mapping: needs --max-error or --max-size"});
}

}  // namespace
}  // namespace paim
