// EXR files of every kind that OpenEXR writes come back as what went in; what Paim writes, OpenEXR
// reads.
#include "paim/image/exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFloatAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "paim/base/error.h"
#include "tests/exr_files.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

// Values that half precision holds exactly, all different.
Image test_image(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const auto i = static_cast<float>(y * width + x);
            image.at(x, y) = Vec3f(i, 0.5f * i, -0.25f * i);
        }
    }
    return image;
}

// Slices over the image whose upper left pixel is `origin` in the file.
Imf::FrameBuffer slices(Image& image, const std::string& channels, Imath::V2i origin = {0, 0}) {
    Imf::FrameBuffer buffer;
    const auto x_stride = static_cast<ptrdiff_t>(sizeof(Vec3f));
    const ptrdiff_t y_stride = x_stride * image.width;
    char* base =
        reinterpret_cast<char*>(image.pixels.data()) - origin.x * x_stride - origin.y * y_stride;
    for (size_t c = 0; c < channels.size(); ++c) {
        buffer.insert(
            std::string(1, channels[c]),
            Imf::Slice(Imf::FLOAT, base + 4 * c, sizeof(Vec3f), static_cast<size_t>(y_stride)));
    }
    return buffer;
}

void insert_channels(Imf::Header& header, const std::string& channels, Imf::PixelType type) {
    for (const char c : channels) header.channels().insert(std::string(1, c), Imf::Channel(type));
}

std::string error_of(const std::filesystem::path& path, const ExrLimits& limits = {}) {
    try {
        read_exr(path, limits);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
        EXPECT_EQ(std::string(error.what()).find(path.string()), 0u) << error.what();
        return error.what();
    }
    return "no error";
}

#define EXPECT_CONTAINS(text, part) \
    EXPECT_NE((text).find(part), std::string::npos) << "in: " << (text)

TEST(Exr, RoundTripIsExact) {
    const TemporaryDirectory directory;
    Image image = test_image(37, 300);
    image.at(3, 2) = Vec3f(1e-30f, 0.1f, 3e38f);  // beyond half precision and range
    image.at(4, 2) = Vec3f(std::numeric_limits<float>::infinity(), 0.0f, -0.0f);
    write_exr(directory / "a.exr", image);
    const Image back = read_exr(directory / "a.exr");
    ASSERT_EQ(back.width, image.width);
    ASSERT_EQ(back.height, image.height);
    EXPECT_EQ(back.pixels, image.pixels);
}

TEST(Exr, WritesZipFloat) {
    const TemporaryDirectory directory;
    write_exr(directory / "a.exr", test_image(2, 2));
    const Imf::InputFile file((directory / "a.exr").c_str());
    EXPECT_EQ(file.header().compression(), Imf::ZIP_COMPRESSION);
    for (const char* name : {"R", "G", "B"}) {
        ASSERT_NE(file.header().channels().findChannel(name), nullptr);
        EXPECT_EQ(file.header().channels().findChannel(name)->type, Imf::FLOAT);
    }
}

TEST(Exr, WriteFailureNamesTheFile) {
    const TemporaryDirectory directory;
    try {
        write_exr(directory / "none" / "a.exr", test_image(2, 2));
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::output_failed);
        EXPECT_CONTAINS(std::string(error.what()), "none/a.exr");
    }
}

TEST(Exr, ReadsEveryLosslessCompressionLineOrderAndType) {
    const TemporaryDirectory directory;
    Image image = test_image(19, 70);
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION,
          Imf::PIZ_COMPRESSION}) {
        for (const Imf::LineOrder order : {Imf::INCREASING_Y, Imf::DECREASING_Y}) {
            Imf::Header header(image.width, image.height);
            header.compression() = compression;
            header.lineOrder() = order;
            insert_channels(header, "RGBA", Imf::FLOAT);
            {
                Imf::OutputFile file((directory / "a.exr").c_str(), header);
                file.setFrameBuffer(slices(image, "RGB"));
                file.writePixels(image.height);
            }
            EXPECT_EQ(read_exr(directory / "a.exr").pixels, image.pixels) << compression;
        }
    }
}

TEST(Exr, ReadsUnsignedIntegers) {
    const TemporaryDirectory directory;
    std::vector<uint32_t> values{7, 70000};
    Imf::Header header(2, 1);
    insert_channels(header, "RGB", Imf::UINT);
    Imf::FrameBuffer buffer;
    for (const char* name : {"R", "G", "B"}) {
        buffer.insert(name, Imf::Slice(Imf::UINT, reinterpret_cast<char*>(values.data()), 4, 8));
    }
    {
        Imf::OutputFile file((directory / "a.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    const Image image = read_exr(directory / "a.exr");
    EXPECT_EQ(image.at(0, 0), Vec3f(7, 7, 7));
    EXPECT_EQ(image.at(1, 0), Vec3f(70000, 70000, 70000));
}

TEST(Exr, ReadsTilesOfEveryLevelMode) {
    const TemporaryDirectory directory;
    Image image = test_image(45, 23);
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        Imf::Header header(image.width, image.height);
        insert_channels(header, "RGB", Imf::FLOAT);
        header.setTileDescription(Imf::TileDescription(16, 8, mode));
        {
            Imf::TiledOutputFile file((directory / "a.exr").c_str(), header);
            Image black(image.width, image.height);
            for (int ly = 0; ly < file.numYLevels(); ++ly) {
                for (int lx = 0; lx < file.numXLevels(); ++lx) {
                    if (!file.isValidLevel(lx, ly)) continue;
                    file.setFrameBuffer(slices(lx + ly == 0 ? image : black, "RGB"));
                    file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
                }
            }
        }
        EXPECT_EQ(read_exr(directory / "a.exr").pixels, image.pixels) << mode;
    }
}

// Writes `image` as the data window at `origin` of a file with the display window, tiled or not.
void write_window(const std::filesystem::path& path, Image& image, const Imath::V2i& origin,
                  const Imath::Box2i& display, bool tiled) {
    const Imath::Box2i data(origin, origin + Imath::V2i(image.width - 1, image.height - 1));
    Imf::Header header(display, data);
    insert_channels(header, "RGB", Imf::FLOAT);
    if (tiled) {
        header.setTileDescription(Imf::TileDescription(4, 8));
        Imf::TiledOutputFile file(path.c_str(), header);
        file.setFrameBuffer(slices(image, "RGB", origin));
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(slices(image, "RGB", origin));
        file.writePixels(image.height);
    }
}

TEST(Exr, PlacesTheDataWindowInTheDisplayWindow) {
    const TemporaryDirectory directory;
    Image data = test_image(20, 10);
    // Inside, overlapping each side, covering, apart, and far from zero.
    for (const bool tiled : {false, true}) {
        for (const auto& [origin, display] :
             {std::pair{Imath::V2i(3, 4), Imath::Box2i({0, 0}, {29, 19})},
              std::pair{Imath::V2i(-7, -4), Imath::Box2i({0, 0}, {29, 19})},
              std::pair{Imath::V2i(17, 14), Imath::Box2i({0, 0}, {29, 19})},
              std::pair{Imath::V2i(-5, -3), Imath::Box2i({1, 1}, {6, 2})},
              std::pair{Imath::V2i(100, 3), Imath::Box2i({0, 0}, {9, 9})},
              std::pair{Imath::V2i(3, 100), Imath::Box2i({0, 0}, {9, 9})},
              std::pair{Imath::V2i(-90000, 70000),
                        Imath::Box2i({-89995, 69995}, {-89970, 70003})}}) {
            write_window(directory / "a.exr", data, origin, display, tiled);
            const Image image = read_exr(directory / "a.exr");
            ASSERT_EQ(image.width, display.max.x - display.min.x + 1);
            ASSERT_EQ(image.height, display.max.y - display.min.y + 1);
            for (int y = 0; y < image.height; ++y) {
                for (int x = 0; x < image.width; ++x) {
                    const int dx = x + display.min.x - origin.x;
                    const int dy = y + display.min.y - origin.y;
                    const bool inside = dx >= 0 && dx < data.width && dy >= 0 && dy < data.height;
                    ASSERT_EQ(image.at(x, y), inside ? data.at(dx, dy) : Vec3f(0, 0, 0))
                        << x << " " << y;
                }
            }
        }
    }
}

TEST(Exr, ReadsLuminanceAsGrey) {
    const TemporaryDirectory directory;
    Image image = test_image(9, 5);
    Imf::Header header(image.width, image.height);
    insert_channels(header, "YZ", Imf::FLOAT);
    {
        Imf::OutputFile file((directory / "a.exr").c_str(), header);
        file.setFrameBuffer(slices(image, "Y"));
        file.writePixels(image.height);
    }
    const Image back = read_exr(directory / "a.exr");
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        EXPECT_EQ(back.pixels[i], Vec3f(Vec3f::Constant(image.pixels[i].x())));
    }
}

TEST(Exr, ConvertsLuminanceChroma) {
    const TemporaryDirectory directory;
    // A constant colour survives the halved chroma; what is left is half precision twice over
    // (2^-11 relative each for luminance and chroma, amplified by the blue weight's 1/0.0722).
    const Vec3f colour(0.5f, 0.25f, 0.75f);
    const std::vector<Imf::Rgba> pixels(24 * 300,
                                        Imf::Rgba(colour.x(), colour.y(), colour.z(), 1.0f));
    {
        Imf::RgbaOutputFile file((directory / "a.exr").c_str(), 24, 300, Imf::WRITE_YC);
        file.setFrameBuffer(pixels.data(), 1, 24);
        file.writePixels(300);
    }
    const Image image = read_exr(directory / "a.exr");
    ASSERT_EQ(image.width, 24);
    ASSERT_EQ(image.height, 300);
    for (const Vec3f& pixel : image.pixels) {
        EXPECT_LT((pixel - colour).cwiseAbs().maxCoeff(), 0.01f) << pixel.transpose();
    }
}

TEST(Exr, ReadsTheFirstPart) {
    const TemporaryDirectory directory;
    Image first = test_image(8, 6);
    Image second(5, 5, Vec3f(9, 9, 9));
    std::vector<Imf::Header> headers{Imf::Header(8, 6), Imf::Header(5, 5)};
    headers[0].setName("first");
    headers[1].setName("second");
    for (Imf::Header& header : headers) {
        header.setType(Imf::SCANLINEIMAGE);
        insert_channels(header, "RGB", Imf::FLOAT);
    }
    headers[1].displayWindow() = headers[0].displayWindow();  // shared by all parts
    {
        Imf::MultiPartOutputFile file((directory / "a.exr").c_str(), headers.data(), 2);
        Imf::OutputPart part_0(file, 0);
        part_0.setFrameBuffer(slices(first, "RGB"));
        part_0.writePixels(first.height);
        Imf::OutputPart part_1(file, 1);
        part_1.setFrameBuffer(slices(second, "RGB"));
        part_1.writePixels(second.height);
    }
    EXPECT_EQ(read_exr(directory / "a.exr").pixels, first.pixels);
}

TEST(Exr, HeadersSayWhatIsThere) {
    const TemporaryDirectory directory;
    const std::filesystem::path path = directory / "a.exr";
    const Image image = test_image(6, 5);
    write_exr_with(path, image);
    ExrHeader header = read_exr_header(path);
    EXPECT_EQ(header.width, 6);
    EXPECT_EQ(header.height, 5);
    EXPECT_EQ(header.num_parts, 1);
    EXPECT_FALSE(header.envmap || header.chromaticities || header.white_luminance);
    write_exr_with(path, image, [](Imf::Header& h) {
        mark_as_cube(h);
        mark_as_ap0(h);
        Imf::addWhiteLuminance(h, 80.0f);
    });
    header = read_exr_header(path);
    EXPECT_EQ(header.envmap, 1);
    EXPECT_EQ(header.white_luminance, 80.0);
    ASSERT_TRUE(header.chromaticities);
    EXPECT_LT((header.chromaticities->blue - Eigen::Vector2d(0.0001, -0.077)).norm(), 1e-7);
    EXPECT_LT((header.chromaticities->white - Eigen::Vector2d(0.32168, 0.33767)).norm(), 1e-7);
    // Names of attributes that hold something else.
    write_exr_with(path, image, [](Imf::Header& h) {
        h.insert("envmap", Imf::StringAttribute("cube"));
        h.insert("chromaticities", Imf::FloatAttribute(1.0f));
    });
    header = read_exr_header(path);
    EXPECT_FALSE(header.envmap || header.chromaticities);
    EXPECT_CONTAINS(error_of(path, {5, 5}), "6 x 5");
    EXPECT_THROW(read_exr_header(path, {5, 5}), Error);
}

// Every pixel of the data window once, those of a row from left to right.
TEST(Exr, RowsComeInRuns) {
    const TemporaryDirectory directory;
    Image image = test_image(45, 23);
    for (const bool tiled : {false, true}) {
        write_window(directory / "a.exr", image, {0, 0}, Imath::Box2i({0, 0}, {44, 22}), tiled);
        std::vector<int> next(23, 0);
        read_exr_rows(directory / "a.exr", [&](int x, int y, std::span<const Vec3f> pixels) {
            ASSERT_EQ(x, next[static_cast<size_t>(y)]);
            next[static_cast<size_t>(y)] += static_cast<int>(pixels.size());
            for (const Vec3f& pixel : pixels) ASSERT_EQ(pixel, image.at(x++, y));
        });
        EXPECT_EQ(next, std::vector<int>(23, 45));
    }
}

TEST(Exr, RefusesDeepImages) {
    const TemporaryDirectory directory;
    Imf::Header header(2, 1);
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
    {
        std::vector<unsigned> counts{1, 1};
        std::vector<float> depth{1.0f, 2.0f};
        std::vector<float*> pointers{&depth[0], &depth[1]};
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(
            Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), 4, 8));
        buffer.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()),
                                          sizeof(float*), 2 * sizeof(float*), sizeof(float)));
        Imf::DeepScanLineOutputFile file((directory / "a.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    EXPECT_CONTAINS(error_of(directory / "a.exr"), "deep");
}

TEST(Exr, RefusesOtherChannels) {
    const TemporaryDirectory directory;
    Image image = test_image(4, 4);
    Imf::Header header(4, 4);
    insert_channels(header, "ZR", Imf::FLOAT);
    {
        Imf::OutputFile file((directory / "a.exr").c_str(), header);
        file.setFrameBuffer(slices(image, "ZR"));
        file.writePixels(4);
    }
    EXPECT_CONTAINS(error_of(directory / "a.exr"), "channels R, Z, expected R, G, B or Y");
}

TEST(Exr, RefusesSubsampledColour) {
    const TemporaryDirectory directory;
    std::vector<float> values(16, 1.0f);
    Imf::Header header(4, 4);
    Imf::FrameBuffer buffer;
    for (const char* name : {"R", "G", "B"}) {
        const int sampling = *name == 'G' ? 2 : 1;
        header.channels().insert(name, Imf::Channel(Imf::FLOAT, sampling, sampling));
        buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 16,
                                       sampling, sampling));
    }
    {
        Imf::OutputFile file((directory / "a.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(4);
    }
    EXPECT_CONTAINS(error_of(directory / "a.exr"), "channel G is sampled every 2 x 2");
}

TEST(Exr, RefusesWhatIsLargerThanTheLimits) {
    const TemporaryDirectory directory;
    write_exr(directory / "a.exr", test_image(30, 20));
    EXPECT_EQ(read_exr(directory / "a.exr", {30, 20}).width, 30);
    EXPECT_CONTAINS(error_of(directory / "a.exr", {29, 20}), "30 x 20");
    EXPECT_CONTAINS(error_of(directory / "a.exr", {30, 19}), "at most 30 x 19");
}

}  // namespace
}  // namespace paim
