// Images on faces: map_Kd, texture coordinates of corners, colours for bounces.
#include "compressor/io/obj_texture.h"

#include <fmt/format.h>

#include <map>

#include "compressor/io/texture_corners.h"
#include "tests/texture_bytes.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

using Lines = std::vector<std::string>;

const std::string kFour = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kCoordinates = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
const std::string kSkin = "newmtl skin\nmap_Kd skin.png\n";
constexpr Rgb8 kRed{255, 0, 0}, kBlue{0, 0, 255};

std::string text_of(const std::vector<uint8_t>& bytes) {
    return {bytes.begin(), bytes.end()};
}

// One colour; `size` columns and rows.
std::string png_of(const Rgb8& color, uint32_t size = 2) {
    return text_of(png_bytes(size, size, std::vector<Rgb8>(size_t{size} * size, color)));
}

// One file "0.obj" of these lines, with library "x.mtl".
struct TexturedFiles : ObjTestFiles {
    TexturedFiles(const std::string& library, const std::string& lines)
        : ObjTestFiles({"mtllib x.mtl\n" + lines}) {
        add("x.mtl", library);
    }
};

// u v of each corner of a triangle, with its vertex.
using Corners = std::map<uint32_t, std::pair<float, float>>;
Corners corners_of(const ObjSequence& sequence, size_t face) {
    Corners corners;
    const Texture& texture = sequence.texture();
    for (size_t k = 0; k < 3; ++k) {
        const Vec2f& uv = texture.coordinates.at(texture.corners.at(face)[k]);
        corners[sequence.topology().triangles[face][k]] = {uv.x(), uv.y()};
    }
    return corners;
}

TEST(ObjTexture, FacesHaveTheImageOfTheirMaterial) {
    const TexturedFiles files(
        "newmtl plain\nKd 0.5 0.5 0.5\nnewmtl skin\nKd 0.5 1 1\nmap_Kd skin.png\n",
        kFour + kCoordinates + "usemtl plain\nf 1 2 3\nusemtl skin\nf 1/1 3/3 4/4\n");
    files.add("skin.png", png_of(kRed));
    const ObjSequence sequence(files.files());
    EXPECT_TRUE(sequence.warnings().empty());
    const Texture& texture = sequence.texture();
    ASSERT_EQ(texture.images.size(), 1u);
    EXPECT_EQ(texture.images[0].name, "skin.png");
    EXPECT_EQ(text_of(texture.images[0].bytes), png_of(kRed));
    EXPECT_EQ(texture.image_of_face, (std::vector<uint16_t>{0, 1}));
    EXPECT_EQ(texture.factors, std::vector<Vec3f>{Vec3f(0.5f, 1, 1)});
    EXPECT_EQ(texture.corners[0], Triangle{});
    EXPECT_EQ(corners_of(sequence, 1), (Corners{{0, {0, 0}}, {2, {1, 1}}, {3, {0, 1}}}));
    EXPECT_EQ(texture.coordinates.size(), 3u);  // those that are used
    // For bounces: red times Kd where the image is, and the mean of both faces between.
    EXPECT_TRUE(sequence.albedo().at(3).isApprox(Vec3f(0.5f, 0, 0), 1e-5f));
    EXPECT_EQ(sequence.albedo().at(1), Vec3f(0.5f, 0.5f, 0.5f));
    EXPECT_TRUE(sequence.albedo().at(0).isApprox(Vec3f(0.5f, 0.25f, 0.25f), 1e-5f));
}

TEST(ObjTexture, SeamsSplitNoVertex) {
    // Vertices 1 and 3 have other coordinates on the two faces.
    const TexturedFiles files(
        kSkin, kFour + kCoordinates +
                   "vt 0.25 0.5\nvt 0.75 0.5\nusemtl skin\nf 1/1 2/2 3/3\nf 1/5 3/6 4/4\n");
    files.add("skin.png", png_of(kRed));
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.topology().num_vertices, 4u);
    EXPECT_EQ(corners_of(sequence, 0), (Corners{{0, {0, 0}}, {1, {1, 0}}, {2, {1, 1}}}));
    EXPECT_EQ(corners_of(sequence, 1),
              (Corners{{0, {0.25f, 0.5f}}, {2, {0.75f, 0.5f}}, {3, {0, 1}}}));
}

TEST(ObjTexture, CornersOfPolygonsGoWithTheirVertices) {
    // A concave polygon whose vertices have their places as coordinates, so that any cut is right.
    std::string lines = "v 9 9 9\n";
    const int places[][2] = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};
    std::string face = "f";
    for (int i = 0; i < 5; ++i) {
        const auto [x, y] = places[i];
        lines += fmt::format("v {} {} 0\nvt {} {} 0\n", x, y, x, y);
        face += fmt::format(" {}/{}", i + 2, i - 5);  // counted from the end
    }
    const TexturedFiles files(kSkin, lines + "usemtl skin\n" + face + "\n");
    files.add("skin.png", png_of(kRed));
    const ObjSequence sequence(files.files());
    ASSERT_EQ(sequence.topology().triangles.size(), 3u);
    const Pose pose = sequence.load_pose(0);
    for (size_t f = 0; f < 3; ++f) {
        for (const auto& [vertex, uv] : corners_of(sequence, f)) {
            EXPECT_EQ(uv, std::pair(pose.positions[vertex].x(), pose.positions[vertex].y()));
        }
    }
}

TEST(ObjTexture, TurnedTrianglesKeepTheirCoordinates) {
    // A tetrahedron that faces inwards; each corner's coordinate names its vertex.
    const std::string inward =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 2 0\nvt 3 0\nusemtl skin\n"
        "f 1/1 2/2 3/3\nf 1/1 4/4 2/2\nf 2/2 4/4 3/3\nf 3/3 4/4 1/1\n";
    const TexturedFiles files(kSkin, inward);
    files.add("skin.png", png_of(kRed));
    ObjOptions options;
    options.orient = true;
    const ObjSequence turned(files.files(), options);
    ASSERT_EQ(turned.num_inward(), 1u);
    EXPECT_NE(turned.topology().triangles, ObjSequence(files.files()).topology().triangles);
    for (size_t f = 0; f < 4; ++f) {
        for (const auto& [vertex, uv] : corners_of(turned, f)) {
            EXPECT_EQ(uv.first, static_cast<float>(vertex));
        }
    }
}

TEST(ObjTexture, RepeatedVerticesHaveTheFirstOfTheirCoordinates) {
    const Polygons polygons{{3, 5}, {0, 1, 2, 4, 3, 4, 5, 6}};
    CornerFinder finder(polygons);
    EXPECT_EQ(finder.find(0, {2, 0, 1}), (Triangle{2, 0, 1}));
    EXPECT_EQ(finder.find(1, {6, 4, 3}), (Triangle{7, 3, 4}));
    EXPECT_EQ(finder.find(0, {0, 1, 2}), (Triangle{0, 1, 2}));
}

TEST(ObjTexture, FacesWithoutCoordinatesKeepKd) {
    const TexturedFiles files(
        "newmtl skin\nKd 0.5 0.5 0.5\nmap_Kd skin.png\n",
        kFour +
            "vt 0 0\nvt nan 1\nvt 1e99 x\nusemtl skin\nf 1/1 2 3/1\nf 1/2 3/3 4/9\n"
            "f 1/2 3/3 4/1\n");
    files.add("skin.png", png_of(kRed));
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.texture().image_of_face, (std::vector<uint16_t>{0, 0, 1}));
    EXPECT_EQ(files.warnings(sequence),
              Lines{"0.obj: 2 triangles have no texture coordinates (vt) for the image of their "
                    "material: Kd takes its place"});
    // Numbers that are none are 0.
    EXPECT_EQ(corners_of(sequence, 2), (Corners{{0, {0, 0}}, {2, {0, 0}}, {3, {0, 0}}}));
    EXPECT_EQ(sequence.albedo().at(1), Vec3f(0.5f, 0.5f, 0.5f));
}

TEST(ObjTexture, MissingAndDamagedImagesLeaveKd) {
    const std::string good = png_of(kRed, 64);
    const std::pair<std::string, std::string> cases[] = {
        {"", ".: image 'skin.png' of material 'skin' not found: Kd takes its place"},
        {"not an image", "skin.png: neither a PNG nor a JPEG image: Kd takes its place"},
        {good.substr(0, good.size() / 2), ": Kd takes its place"},
        {good.substr(0, 20), ": Kd takes its place"},
    };
    for (const auto& [bytes, warning] : cases) {
        const TexturedFiles files("newmtl skin\nKd 0.25 0.5 0.75\nmap_Kd skin.png\n",
                                  kFour + kCoordinates + "usemtl skin\nf 1/1 2/2 3/3 4/4\n");
        if (!bytes.empty()) files.add("skin.png", bytes);
        const ObjSequence sequence(files.files());
        EXPECT_TRUE(sequence.texture() == Texture());
        EXPECT_EQ(sequence.albedo().values, (std::vector<Vec3f>{{0.25f, 0.5f, 0.75f}}));
        const Lines warnings = files.warnings(sequence);
        ASSERT_EQ(warnings.size(), 1u) << warning;
        if (bytes.empty()) {
            const std::string folder = files.files()[0].parent_path().string();
            EXPECT_EQ(sequence.warnings()[0], folder + warning.substr(1));
        } else {
            EXPECT_TRUE(warnings[0].starts_with("skin.png: ") && warnings[0].ends_with(warning))
                << warnings[0];
        }
    }
}

TEST(ObjTexture, ImagesAreFoundUnderTheNamesOfOtherMachines) {
    for (const char* name : {"tex\\skin one.png", "tex/skin one.png", "\"tex/skin one.png\"",
                             "TEX\\Skin One.PNG", "C:\\work\\other.png", "./tex/../other.png"}) {
        const TexturedFiles files(std::string("newmtl skin\nmap_Kd ") + name + "\n",
                                  kFour + kCoordinates + "usemtl skin\nf 1/1 2/2 3/3 4/4\n");
        std::filesystem::create_directory(files.files()[0].parent_path() / "tex");
        files.add("tex/skin one.png", png_of(kRed));
        files.add("other.png", png_of(kRed));
        EXPECT_EQ(ObjSequence(files.files()).texture().images.size(), 1u) << name;
    }
}

TEST(ObjTexture, NamesAreRelativeToTheLibrary) {
    ObjTestFiles files(
        {"mtllib sub/x.mtl\n" + kFour + kCoordinates + "usemtl skin\nf 1/1 2/2 3/3\n"});
    std::filesystem::create_directory(files.files()[0].parent_path() / "sub");
    files.add("sub/x.mtl", kSkin);
    files.add("sub/skin.png", png_of(kBlue));
    files.add("skin.png", png_of(kRed));
    const ObjSequence sequence(files.files());
    ASSERT_EQ(sequence.texture().images.size(), 1u);
    EXPECT_EQ(text_of(sequence.texture().images[0].bytes), png_of(kBlue));
}

TEST(ObjTexture, AFileIsKeptOnceForEachKd) {
    const TexturedFiles files(
        "newmtl a\nmap_Kd skin.png\nnewmtl b\nKd 1 1 1\nmap_Kd ./skin.png\n"
        "newmtl c\nKd 0.5 0.5 0.5\nmap_Kd skin.png\nnewmtl d\nKd 0 0 0\nmap_Kd skin.png\n"
        "newmtl e\nmap_Kd other.jpg\n",
        kFour + kCoordinates +
            "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 3/3\n"
            "usemtl d\nf 1/1 2/2 3/3\nusemtl e\nf 1/1 2/2 3/3\n");
    files.add("skin.png", png_of(kRed));
    files.add("other.jpg", text_of(jpeg_bytes(16, 16, std::vector<Rgb8>(256, kBlue), 90)));
    const ObjSequence sequence(files.files());
    const Texture& texture = sequence.texture();
    EXPECT_TRUE(sequence.warnings().empty());
    ASSERT_EQ(texture.images.size(), 3u);
    EXPECT_EQ(texture.images[0], texture.images[1]);
    EXPECT_EQ(texture.images[2].name, "other.jpg");
    EXPECT_EQ(texture.image_of_face, (std::vector<uint16_t>{1, 1, 2, 1, 3}));
    EXPECT_EQ(texture.factors[0], Vec3f(1, 1, 1));
    EXPECT_EQ(texture.factors[1], Vec3f(0.5f, 0.5f, 0.5f));
    EXPECT_EQ(texture.coordinates.size(), 3u);
}

TEST(ObjTexture, ScaleAndOffsetMoveCoordinates) {
    const TexturedFiles files(
        "newmtl a\nmap_Kd -s 2 4 -o 0.5 -1 skin.png\nnewmtl b\nmap_Kd -clamp on skin.png\n",
        kFour + kCoordinates + "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\n");
    files.add("skin.png", png_of(kRed));
    const ObjSequence sequence(files.files());
    EXPECT_EQ(corners_of(sequence, 0), (Corners{{0, {0.5f, -1}}, {1, {2.5f, -1}}, {2, {2.5f, 3}}}));
    EXPECT_EQ(corners_of(sequence, 1), (Corners{{0, {0, 0}}, {1, {1, 0}}, {2, {1, 1}}}));
    EXPECT_EQ(files.warnings(sequence),
              Lines{"0.obj: map_Kd of material 'b': option -clamp is not read (only -s and -o are, "
                    "and images repeat)"});
}

TEST(ObjTexture, NoTexturesIsAsBefore) {
    const TexturedFiles files("newmtl skin\nKd 0.25 0.5 0.75\nmap_Kd skin.png\n",
                              kFour + kCoordinates + "usemtl skin\nf 1/1 2/2 3/3 4/4\n");
    files.add("skin.png", png_of(kRed));
    ObjOptions options;
    options.textures = false;
    const ObjSequence sequence(files.files(), options);
    EXPECT_TRUE(sequence.texture().empty());
    EXPECT_EQ(sequence.albedo().values, (std::vector<Vec3f>{{0.25f, 0.5f, 0.75f}}));
    EXPECT_EQ(files.warnings(sequence),
              Lines{"0.obj: textures are not read: map_Kd of 1 materials, e.g. skin.png"});
    // Vertex colours and --albedo count before materials, and so before their images.
    options.textures = true;
    options.albedo = Vec3f(0.5f, 0.5f, 0.5f);
    EXPECT_TRUE(ObjSequence(files.files(), options).texture().empty());
}

TEST(ObjTexture, TheFirstFileDecides) {
    const std::string faces = "usemtl skin\nf 1/1 2/2 3/3\n";
    const ObjTestFiles files({"mtllib x.mtl\n" + kFour + kCoordinates + faces,
                              "mtllib y.mtl\n" + kFour + "vt 9 9\nusemtl other\nf 1/1 2/1 3/1\n"});
    files.add("x.mtl", kSkin);
    files.add("skin.png", png_of(kRed));
    const ObjSequence sequence(files.files());
    EXPECT_TRUE(sequence.warnings().empty());
    EXPECT_EQ(corners_of(sequence, 0), (Corners{{0, {0, 0}}, {1, {1, 0}}, {2, {1, 1}}}));
}

TEST(ObjTexture, TheColourOfAPolygonIsTheMeanOfItsTrianglesByArea) {
    // A quad that is cut along the diagonal of its vertices 2 and 4, which are the nearer ones. Its
    // triangle 1 2 4 is in the red half of the image and 2 3 4 in the blue one, with a third of the
    // area. (Both have the coordinates of 2 and 4, on the line between the halves.)
    const TexturedFiles files(kSkin,
                              "v 0 0 0\nv 2 1 0\nv 4 4 0\nv 1 2 0\nvt 0.125 0.5\nvt 0.5 0.25\n"
                              "vt 0.625 0.5\nvt 0.5 0.75\nusemtl skin\nf 1/1 2/2 3/3 4/4\n");
    std::vector<Rgb8> pixels(64 * 64);
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = i % 64 < 32 ? kRed : kBlue;
    files.add("skin.png", text_of(png_bytes(64, 64, pixels)));
    const ObjSequence sequence(files.files());
    ASSERT_EQ(sequence.topology().triangles[0], (Triangle{0, 1, 3}));
    ASSERT_EQ(sequence.albedo().values.size(), 1u);  // all faces have one colour
    // Level 0 or 1: samples within a pixel of the line mix the halves, by half at most. The triangles
    // are 24 and 8 columns wide, and highest at the line: 2 of 24 and 1 of 4 of their areas at most.
    const Vec3f color = sequence.albedo().at(0);
    EXPECT_NEAR(color[0], 0.75f, 0.06f);
    EXPECT_NEAR(color[2], 0.25f, 0.06f);
    EXPECT_NEAR(color[0] + color[2], 1.0f, 1e-5f);
}

TEST(ObjTexture, EveryFaceOfManyHasItsOwnColour) {
    // A thousand triangles, each in one of two halves of the image.
    std::string lines = kFour + "vt 0.125 0.5\nvt 0.875 0.5\nusemtl skin\n";
    for (int i = 0; i < 1000; ++i) {
        lines += fmt::format("v {0} 0 0\nv {0} 1 0\nv {0} 0 1\nf {1}/{4} {2}/{4} {3}/{4}\n", i,
                             3 * i + 5, 3 * i + 6, 3 * i + 7, i % 3 == 0 ? 1 : 2);
    }
    const TexturedFiles files(kSkin, lines);
    files.add("skin.png", text_of(png_bytes(2, 1, std::vector<Rgb8>{kRed, kBlue})));
    const ObjSequence sequence(files.files());
    for (uint32_t i = 0; i < 1000; ++i) {
        // Vertices 1 to 4 have no face. Pixels' centres are at 1/4 and 3/4: places at 1/8 and 7/8
        // are mixed with the other half by a quarter, as the image repeats.
        const Vec3f mostly = i % 3 == 0 ? Vec3f(0.75f, 0, 0.25f) : Vec3f(0.25f, 0, 0.75f);
        EXPECT_TRUE(sequence.albedo().at(3 * i + 4).isApprox(mostly, 1e-5f)) << i;
    }
}

}  // namespace
}  // namespace paim
