// Environment maps as they come: mappings, colours, parts, sizes.
#include "paim/light/load_light.h"

#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "paim/base/error.h"
#include "tests/exr_files.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

class LoadLight : public testing::Test {
  protected:
    LoadedLight load(const Image& image, const std::function<void(Imf::Header&)>& describe = {},
                     EnvMapping mapping = EnvMapping::automatic) const {
        write_exr_with(file_, image, describe);
        return load_light(file_, mapping);
    }

    std::string error_of(const Image& image, const std::function<void(Imf::Header&)>& describe = {},
                         EnvMapping mapping = EnvMapping::automatic) const {
        try {
            load(image, describe, mapping);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_EQ(std::string(error.what()).find(file_.string() + ": "), 0u) << error.what();
            return error.what();
        }
        return "no error";
    }

    static bool notes_have(const LoadedLight& loaded, const std::string& part) {
        for (const std::string& note : loaded.notes) {
            if (note.find(part) != std::string::npos) return true;
        }
        return false;
    }

    TemporaryDirectory directory_;
    std::filesystem::path file_ = directory_ / "light.exr";
};

// +X is red, all else dim.
Image red_cube(int size) {
    Image cube(size, 6 * size, Vec3f::Constant(0.1f));
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) cube.at(x, y) = Vec3f(3, 0.1f, 0.1f);
    }
    return cube;
}

Image probe(int size) {
    Image image(size, size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            if (std::hypot(x + 0.5 - 0.5 * size, y + 0.5 - 0.5 * size) > 0.5 * size) continue;
            image.at(x, y) = x > size / 2 ? Vec3f(2, 1, 1) : Vec3f(1, 1, 1);
        }
    }
    return image;
}

TEST_F(LoadLight, OrdinaryMapsStayAsTheyAre) {
    Image image(8, 4, Vec3f(1, 2, 3));
    image.at(5, 2) = Vec3f(0.1f, 1e5f, -0.01f);
    const LoadedLight loaded = load(image);
    EXPECT_EQ(loaded.light.image().pixels, image.pixels);
    EXPECT_EQ(loaded.mapping.mapping, EnvMapping::latlong);
    EXPECT_FALSE(loaded.converted_colours);
    EXPECT_TRUE(loaded.notes.empty());
    // The attribute says the same.
    const auto mark = [](Imf::Header& header) { Imf::addEnvmap(header, Imf::ENVMAP_LATLONG); };
    EXPECT_EQ(load(image, mark).light.image().pixels, image.pixels);
}

TEST_F(LoadLight, CubeMapsAreConverted) {
    const LoadedLight loaded = load(red_cube(8), mark_as_cube);
    EXPECT_EQ(loaded.mapping.mapping, EnvMapping::cube);
    EXPECT_TRUE(loaded.notes.empty());
    const Image& map = loaded.light.image();
    EXPECT_EQ(map.width, 2 * map.height);
    EXPECT_NEAR(loaded.light.radiance(Vec3d(1, 0.5, -0.5)).x(), 3.0, 1e-5);
    EXPECT_NEAR(loaded.light.radiance(Vec3d(-1, 0.5, -0.5)).x(), 0.1, 1e-5);
    // Six squares without the attribute are read the same, with a word.
    const LoadedLight unmarked = load(red_cube(8));
    EXPECT_EQ(unmarked.light.image().pixels, map.pixels);
    EXPECT_TRUE(notes_have(unmarked, "8 x 48 pixels, expected 2:1"));
    // The option comes first.
    EXPECT_EQ(load(red_cube(8), mark_as_cube, EnvMapping::latlong).light.image().width, 8);
    EXPECT_NE(error_of(Image(8, 40, Vec3f::Ones()), mark_as_cube).find("N x 6 N pixels"),
              std::string::npos);
}

// Crosses and rows of six faces are no cube maps of OpenEXR.
TEST_F(LoadLight, OtherLayoutsOfCubesAreRefusedOrNoted) {
    for (const auto& [width, height] : {std::pair{32, 24}, {24, 32}, {48, 8}, {8, 8}}) {
        const Image image(width, height, Vec3f::Ones());
        EXPECT_NE(error_of(image, mark_as_cube).find("N x 6 N pixels"), std::string::npos) << width;
        EXPECT_NE(error_of(image, {}, EnvMapping::cube).find("N x 6 N pixels"), std::string::npos);
        EXPECT_TRUE(notes_have(load(image), "expected 2:1")) << width;
    }
}

TEST_F(LoadLight, LightProbesAreConverted) {
    const LoadedLight asked = load(probe(32), {}, EnvMapping::angular);
    EXPECT_TRUE(asked.notes.empty());
    EXPECT_NEAR(asked.light.radiance(Vec3d::UnitX()).x(), 2.0, 1e-5);
    EXPECT_NEAR(asked.light.radiance(-Vec3d::UnitX()).x(), 1.0, 1e-5);
    // Black corners tell, with a word.
    const LoadedLight found = load(probe(32));
    EXPECT_EQ(found.mapping.mapping, EnvMapping::angular);
    EXPECT_EQ(found.light.image().pixels, asked.light.image().pixels);
    EXPECT_TRUE(notes_have(found, "32 x 32 pixels, expected 2:1"));
    // What is in the corners is no light, if the user says so.
    Image bright = probe(32);
    bright.at(0, 0) = Vec3f::Constant(std::numeric_limits<float>::quiet_NaN());
    bright.at(31, 31) = Vec3f::Constant(1e30f);
    EXPECT_EQ(load(bright, {}, EnvMapping::angular).light.image().pixels,
              asked.light.image().pixels);
    EXPECT_NE(error_of(Image(8, 4, Vec3f::Ones()), {}, EnvMapping::angular).find("N x N pixels"),
              std::string::npos);
}

TEST_F(LoadLight, OtherShapesAreNoted) {
    for (const auto& [width, height] : {std::pair{6, 6}, {7, 4}, {4, 3}, {1, 1}, {3, 16}}) {
        const LoadedLight loaded = load(Image(width, height, Vec3f::Ones()));
        EXPECT_EQ(loaded.mapping.mapping, EnvMapping::latlong);
        EXPECT_EQ(loaded.light.image().pixels.size(), static_cast<size_t>(width * height));
        EXPECT_TRUE(notes_have(loaded, "expected 2:1; read as a lat-long map")) << width;
    }
    EXPECT_TRUE(notes_have(load(Image(6, 6, Vec3f::Ones())), "--env-mapping angular"));
    EXPECT_TRUE(notes_have(load(Image(6, 6, Vec3f::Ones()), {}, EnvMapping::latlong), "2:1"));
}

TEST_F(LoadLight, ColoursBecomeRec709) {
    // The light of Rec. 709's red and of a grey, in the primaries of AP0: columns of the inverse
    // of the matrix.
    Chromaticities ap0{{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, {0.32168, 0.33767}};
    const Eigen::Matrix3d ap0_from_rec709 = rec709_from(ap0)->inverse();
    const Eigen::Vector3f red = (ap0_from_rec709 * Vec3d(2, 0, 0)).cast<float>();
    Image image(4, 2, red);
    image.at(0, 0) = Vec3f::Constant(0.5f);
    const LoadedLight loaded = load(image, mark_as_ap0);
    EXPECT_TRUE(loaded.converted_colours);
    EXPECT_LT((loaded.light.image().at(1, 1) - Vec3f(2, 0, 0)).norm(), 1e-5f);
    EXPECT_LT((loaded.light.image().at(0, 0) - Vec3f::Constant(0.5f)).norm(), 1e-6f);
    // A colour that Rec. 709 does not have is light, too.
    const LoadedLight green = load(Image(4, 2, Vec3f(0, 1, 0)), mark_as_ap0);
    EXPECT_LT(green.light.image().at(0, 0).x(), -1.0f);
    EXPECT_GT(green.light.image().at(0, 0).y(), 1.3f);
    // Its own values are checked, not the converted ones.
    EXPECT_NE(error_of(Image(4, 2, Vec3f(0, -1, 0)), mark_as_ap0).find("is -1"), std::string::npos);
}

TEST_F(LoadLight, ColoursOfManySpacesBecomeRec709) {
    const std::vector<Chromaticities> spaces{
        {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}},  // ACES AP1
        {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}},    // Rec. 2020
        {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}};   // P3, D65
    const auto to_file = [](const Eigen::Vector2d& xy) {
        return Imath::V2f(static_cast<float>(xy.x()), static_cast<float>(xy.y()));
    };
    for (const Chromaticities& space : spaces) {
        const Eigen::Matrix3d from_rec709 = rec709_from(space)->inverse();
        for (const Vec3d& colour : {Vec3d(2, 0, 0), Vec3d(0, 2, 0), Vec3d(0.1, 0.2, 2)}) {
            const Image image(4, 2, (from_rec709 * colour).cast<float>());
            const LoadedLight loaded = load(image, [&](Imf::Header& header) {
                Imf::addChromaticities(header, {to_file(space.red), to_file(space.green),
                                                to_file(space.blue), to_file(space.white)});
            });
            EXPECT_TRUE(loaded.converted_colours);
            EXPECT_TRUE(loaded.notes.empty());
            // Pixels and chromaticities are rounded to float.
            EXPECT_LT((loaded.light.image().at(1, 1) - colour.cast<float>()).norm(), 1e-5f);
        }
    }
}

TEST_F(LoadLight, ColoursThatAreNoneAreNoted) {
    const Image image(4, 2, Vec3f(1, 2, 3));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Imf::Chromaticities& bogus :
         {Imf::Chromaticities({nan, 0.3f}), Imf::Chromaticities({0, 0}, {0, 0}, {0, 0}, {0, 0}),
          Imf::Chromaticities({0.64f, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.9f, 0.9f})}) {
        const LoadedLight loaded =
            load(image, [&](Imf::Header& header) { Imf::addChromaticities(header, bogus); });
        EXPECT_EQ(loaded.light.image().pixels, image.pixels);
        EXPECT_FALSE(loaded.converted_colours);
        EXPECT_TRUE(notes_have(loaded, "no colour space"));
    }
}

TEST_F(LoadLight, RefusesWhatIsNoRadiance) {
    Image image(8, 4, Vec3f::Ones());
    image.at(3, 2).y() = std::numeric_limits<float>::infinity();
    EXPECT_NE(error_of(image).find("pixel (3, 2) is inf"), std::string::npos);
    Image cube = red_cube(4);
    cube.at(1, 20).x() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(error_of(cube, mark_as_cube).find("pixel (1, 20) is nan"), std::string::npos);
    EXPECT_THROW(load_light(directory_ / "none.exr"), Error);
}

TEST_F(LoadLight, BlackIsNoted) {
    EXPECT_TRUE(notes_have(load(Image(4, 2)), "black"));
    EXPECT_TRUE(load(Image(4, 2)).light.is_black());
    EXPECT_FALSE(load(Image(4, 2, Vec3f(0, 0, 1))).light.is_black());
    EXPECT_EQ(load(Image(4, 4)).mapping.mapping, EnvMapping::latlong);  // no probe
}

TEST_F(LoadLight, OtherPartsAreNoted) {
    std::vector<Imf::Header> headers{Imf::Header(4, 2), Imf::Header(4, 2)};
    headers[0].setName("left");
    headers[1].setName("right");
    std::vector<Vec3f> pixels(8, Vec3f(1, 2, 3));
    for (Imf::Header& header : headers) {
        header.setType(Imf::SCANLINEIMAGE);
        for (const char* name : {"R", "G", "B"}) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        }
    }
    {
        Imf::MultiPartOutputFile file(file_.c_str(), headers.data(), 2);
        for (int part = 0; part < 2; ++part) {
            Imf::FrameBuffer buffer;
            size_t c = 0;
            for (const char* name : {"R", "G", "B"}) {
                buffer.insert(
                    name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()) + 4 * c++,
                                     sizeof(Vec3f), 4 * sizeof(Vec3f)));
            }
            Imf::OutputPart output(file, part);
            output.setFrameBuffer(buffer);
            output.writePixels(2);
        }
    }
    const LoadedLight loaded = load_light(file_);
    EXPECT_EQ(loaded.header.num_parts, 2);
    EXPECT_TRUE(notes_have(loaded, "2 parts; the first, 'left', is read"));
}

// Larger maps are averaged down while they are read; their light stays.
TEST_F(LoadLight, LargeMapsKeepTheirLight) {
    Image image(kMaxMapWidth + 1000, 64);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Vec3d d = direction_from_latlong((x + 0.5) / image.width, (y + 0.5) / 64);
            image.at(x, y) = Vec3f(static_cast<float>(1.0 + d.x()), static_cast<float>(2.0 - d.z()),
                                   x % 97 == 0 ? 100.0f : 0.0f);
        }
    }
    const LoadedLight loaded = load(image);
    EXPECT_EQ(loaded.light.image().width, kMaxMapWidth);
    EXPECT_EQ(loaded.light.image().height, 64);
    const auto small = loaded.light.coefficients(5).values;
    const auto large = project_latlong(image, 5).values;
    for (size_t i = 0; i < large.size(); ++i) {
        // A bright column moves by h / 2 = π / 4096 at most, and its coefficient of band l <= 4 by
        // l times that; the 53 columns move at random. Observed 5e-5.
        EXPECT_LT((small[i] - large[i]).norm(), 4e-4f * large[0].norm()) << i;
    }
}

}  // namespace
}  // namespace paim
