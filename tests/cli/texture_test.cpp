// Textures and gloss of OBJ files through paim-compress and paim-info.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "tests/cli/tool_test.h"
#include "tests/texture_bytes.h"

namespace paim {
namespace {

constexpr Rgb8 kRed{255, 0, 0}, kGreen{0, 255, 0};

// The image and the coordinates of each face, in an order that no reordering changes.
using Face = std::pair<uint16_t, std::array<std::pair<float, float>, 3>>;
std::vector<Face> faces_of(const Texture& texture) {
    std::vector<Face> faces;
    for (size_t f = 0; f < texture.corners.size(); ++f) {
        Face face{texture.image_of_face[f], {}};
        for (size_t k = 0; k < 3 && face.first > 0; ++k) {
            const Vec2f& uv = texture.coordinates[texture.corners[f][k]];
            face.second[k] = {uv.x(), uv.y()};
        }
        std::sort(face.second.begin(), face.second.end());
        faces.push_back(face);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

class Textures : public ToolTest {
  protected:
    void SetUp() override {
        write_image("a.png", png_bytes(2, 2, std::vector<Rgb8>(4, kRed)));
        write_image("b.jpg", jpeg_bytes(16, 8, std::vector<Rgb8>(128, kGreen), 90));
        write("x.mtl",
              "newmtl a\nKd 0.5 0.5 0.5\nKs 0.5 0.5 0.5\nNs 32\nillum 2\nmap_Kd a.png\n"
              "newmtl b\nmap_Kd b.jpg\nnewmtl c\nKd 0.25 0.25 0.25\n");
        for (int p = 0; p < 3; ++p) write(fmt::format("p{}.obj", p), sheet(p));
    }

    void write_image(const std::string& name, const std::vector<uint8_t>& bytes) const {
        write(name, std::string(bytes.begin(), bytes.end()));
    }

    // A sheet of 6 × 6 quads that bends, with coordinates of their own at each corner, and three
    // materials in strips.
    static std::string sheet(int pose) {
        std::string text = "mtllib x.mtl\n";
        for (int y = 0; y < 7; ++y) {
            for (int x = 0; x < 7; ++x)
                text += fmt::format("v {} {} {}\n", x, 0.1 * pose * x * x, -y);
        }
        std::string faces;
        int number = 0;  // of coordinates
        for (int x = 0; x < 6; ++x) {
            faces += fmt::format("usemtl {}\n", "abc"[x % 3]);
            for (int y = 0; y < 6; ++y, number += 4) {
                for (int k = 1; k <= 4; ++k)
                    text += fmt::format("vt {} 0.5\n", 0.01 * (number + k));
                const int v = 7 * y + x + 1;
                faces += fmt::format("f {}/{} {}/{} {}/{} {}/{}\n", v, number + 1, v + 1,
                                     number + 2, v + 8, number + 3, v + 7, number + 4);
            }
        }
        return text + faces;
    }

    ToolResult bake(const std::string& name, const Arguments& options = {}) const {
        Arguments arguments{"bake", path("p*.obj"), "-o", path(name), "--rays",
                            "2",    "--bands",      "2",  "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return compress(arguments);
    }
};

TEST_F(Textures, GoFromTheFilesIntoTheBakeAndTheAnimation) {
    expect_success(bake("x.bake", {"--floor", "--floor-vertices", "16"}));
    const BakeReader reader(path("x.bake"));
    const Texture& texture = reader.texture();
    ASSERT_EQ(texture.images.size(), 2u);
    EXPECT_EQ(texture.images[0].name, "a.png");
    EXPECT_EQ(texture.images[1].name, "b.jpg");
    EXPECT_EQ(texture.factors[0], Vec3f(0.5f, 0.5f, 0.5f));
    ASSERT_EQ(texture.corners.size(), reader.topology().triangles.size());
    EXPECT_EQ(texture.image_of_face.back(), 0);  // the floor
    const auto textured = [](const Face& face) { return face.first > 0; };
    const std::vector<Face> faces = faces_of(texture);
    EXPECT_EQ(std::count_if(faces.begin(), faces.end(), textured), 48);
    // Light bounces off the colours of the images: vertex 1 has faces of red times 0.5 alone.
    EXPECT_TRUE(reader.albedo().at(0).isApprox(Vec3f(0.5f, 0, 0), 1e-5f));

    for (const Arguments& options : std::vector<Arguments>{{}, {"--max-error", "60%"}}) {
        Arguments arguments{"encode", path("x.bake"), "-o", path("x.paim")};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expect_success(compress(arguments));
        const Asset asset = read_paim(path("x.paim"));
        EXPECT_EQ(asset.moving().texture.images, texture.images);
        EXPECT_EQ(asset.moving().texture.factors, texture.factors);
        EXPECT_EQ(faces_of(asset.moving().texture), faces);
        const uint64_t with = std::filesystem::file_size(path("x.paim"));
        arguments.push_back("--no-textures");
        expect_success(compress(arguments));
        EXPECT_TRUE(read_paim(path("x.paim")).moving().texture == Texture());
        EXPECT_LT(std::filesystem::file_size(path("x.paim")), with);
    }
}

TEST_F(Textures, AreListed) {
    expect_success(bake("x.bake"));
    expect_success(compress({"encode", path("x.bake"), "-o", path("x.paim")}));
    for (const char* file : {"x.bake", "x.paim"}) {
        const auto json = parse_object(info({path(file), "--json"}));
        EXPECT_EQ(json["num_textured_triangles"], 48) << file;
        EXPECT_EQ(json["num_texture_coordinates"], 96) << file;
        ASSERT_EQ(json["images"].size(), 2u) << file;
        EXPECT_EQ(json["images"][0]["name"], "a.png");
        EXPECT_EQ(json["images"][0]["pixels"], (std::vector<int>{2, 2}));
        EXPECT_EQ(json["images"][1]["pixels"], (std::vector<int>{16, 8}));
        EXPECT_EQ(json["images"][1]["size_bytes"], std::filesystem::file_size(path("b.jpg")));
        EXPECT_TRUE(contains(info({path(file)}).out, "b.jpg")) << file;
    }
}

TEST_F(Textures, AreNotReadWithNoTextures) {
    const ToolResult result = bake("x.bake", {"--no-textures"});
    expect_success(result);
    EXPECT_TRUE(contains(result.err, "textures are not read: map_Kd of 2 materials"));
    const BakeReader reader(path("x.bake"));
    EXPECT_TRUE(reader.texture() == Texture());
    EXPECT_EQ(reader.albedo().at(0), Vec3f(0.5f, 0.5f, 0.5f));
    EXPECT_FALSE(parse_object(info({path("x.bake"), "--json"})).contains("images"));
}

TEST_F(Textures, ABakeIsOneOfItsImages) {
    expect_success(bake("x.bake"));
    expect_success(bake("x.bake"));
    // The same colour, so that albedo and coordinates stay.
    write_image("a.png", png_bytes(4, 4, std::vector<Rgb8>(16, kRed)));
    expect_failure(bake("x.bake"), 2, {"checksum of faces, albedo and texture"});
}

TEST_F(Textures, StillMeshesHaveTheirOwn) {
    write("stage.obj",
          "mtllib stage.mtl\nv 0 -1 0\nv 9 -1 0\nv 0 -1 -9\nvt 0 0\nvt 1 0\nvt 0 1\n"
          "usemtl s\nf 1/1 2/2 3/3\n");
    write("ground.obj", "v 0 -2 0\nv 9 -2 0\nv 0 -2 -9\nf 1 2 3\n");
    write("stage.mtl", "newmtl s\nmap_Kd b.jpg\n");
    for (const bool first : {true, false}) {
        const std::string name = first ? "x.bake" : "y.bake";
        expect_success(bake(name, {"--static", path(first ? "stage.obj" : "ground.obj"), "--static",
                                   path(first ? "ground.obj" : "stage.obj")}));
        const BakedStillMesh still = BakeReader(path(name)).still_mesh().value();
        EXPECT_EQ(still.texture.image_of_face,
                  (first ? std::vector<uint16_t>{1, 0} : std::vector<uint16_t>{0, 1}));
        ASSERT_EQ(still.texture.images.size(), 1u);
        for (const Arguments& options : std::vector<Arguments>{{}, {"--max-error", "60%"}}) {
            Arguments arguments{"encode", path(name), "-o", path("x.paim")};
            arguments.insert(arguments.end(), options.begin(), options.end());
            expect_success(compress(arguments));
            const Asset asset = read_paim(path("x.paim"));
            ASSERT_TRUE(asset.still() != nullptr);
            EXPECT_EQ(faces_of(asset.still()->texture), faces_of(still.texture));
            EXPECT_EQ(asset.moving().texture.images.size(), 2u);
        }
    }
}

TEST_F(Textures, GlossIsNotedAndItsOptionsAreChecked) {
    const ToolResult result = bake("x.bake");
    expect_success(result);
    EXPECT_TRUE(
        contains(result.err, "1 materials are glossy, e.g. 'a', and baked as matte: --gloss"))
        << result.err;
    expect_failure(bake("y.bake", {"--material", "shiny:1"}), 1, {"--material shiny:1: ", "phong"});
    expect_failure(bake("y.bake", {"--material", "phong:2,32"}), 1, {"--material phong:2,32: "});
    expect_failure(bake("y.bake", {"--material", "z=phong:0.5,32"}), 1,
                   {"no face of ", "has the material 'z', expected 'a', 'b', 'c'"});
    expect_failure(bake("y.bake", {"--gloss-bands", "5"}), 1, {"--gloss-bands: expected IN,OUT"});
    expect_failure(bake("y.bake", {"--gloss-bands", "5,9"}), 1, {"--gloss-bands: expected IN,OUT"});
    expect_failure(bake("y.bake", {"--gloss-bands", "0,3"}), 1, {"--gloss-bands"});
    EXPECT_FALSE(std::filesystem::exists(path("y.bake")));
}

// 4 million vertices of a floor, in 64 bands, take 98 GB a pose; a thousand of them fit on no disk.
TEST_F(Textures, ABakeThatFitsOnNoDiskDoesNotBegin) {
    Arguments arguments{"bake",
                        "-o",
                        path("x.bake"),
                        "--bands",
                        "64",
                        "--floor",
                        "--floor-vertices",
                        "4000000",
                        "--root-motion",
                        "none",
                        "--keep-order"};
    arguments.insert(arguments.end(), 1000, path("p0.obj"));
    expect_failure(compress(arguments), 4, {"x.bake: 1000 poses of ", "GB of the disk are free"});
    EXPECT_FALSE(std::filesystem::exists(path("x.bake")));
}

}  // namespace
}  // namespace paim
