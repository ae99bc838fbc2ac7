// Albedo: option, vertex colours, materials, default, and what is odd about them.
#include "compressor/io/obj_sequence.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

const std::string kFour = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kRedGreen = "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0 # x\n";

using Values = std::vector<Vec3f>;

TEST(ObjAlbedo, TakesTheOptionFirst) {
    const ObjTestFiles files(
        {"mtllib none.mtl\nusemtl a\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\n"
         "v 0 1 0 1 0 0\nf 1 2 3\n"});
    ObjOptions options;
    options.albedo = Vec3f(0.1f, 0.2f, 0.3f);
    const ObjSequence sequence(files.files(), options);
    EXPECT_EQ(sequence.albedo().values, (Values{{0.1f, 0.2f, 0.3f}}));
    EXPECT_TRUE(sequence.warnings().empty());  // materials do not matter then
    EXPECT_EQ(ObjSequence(files.files()).albedo().values, Values(3, Vec3f(1, 0, 0)));
}

TEST(ObjAlbedo, ClampsVertexColors) {
    const ObjTestFiles files({"v 0 0 0 2 0 0\nv 1 0 0 0.5 -1 0\nv 0 1 0 1 1 0.25\nf 1 2 3\n"});
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.albedo().values, (Values{{1, 0, 0}, {0.5f, 0, 0}, {1, 1, 0.25f}}));
    EXPECT_EQ(files.warnings(sequence),
              (std::vector<std::string>{"0.obj: 2 vertex colours clamped to 0..1"}));
}

TEST(ObjAlbedo, IgnoresColorsThatNotAllVerticesHave) {
    const ObjTestFiles files({"v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n"});
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.albedo().values, Albedo().values);
    EXPECT_EQ(files.warnings(sequence),
              (std::vector<std::string>{"0.obj: vertex colours ignored: 1 vertices of faces have "
                                        "none, e.g. vertex 2"}));
    ObjOptions options;
    options.albedo = Vec3f(0, 0, 1);
    EXPECT_TRUE(ObjSequence(files.files(), options).warnings().empty());
}

// A vertex of no face counts for nothing, whether it is the only one with a colour or without.
TEST(ObjAlbedo, NeedsNoColourOfVerticesOfNoFace) {
    for (const std::string odd : {"v 0 0 0\n", "v 0 0 0 1\n", "v 0 0 0 0 1 0\n"}) {
        const std::string red = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\n";
        for (const std::string& text : {odd + red + "f 2 3 4\n", red + odd + "f 1 2 3\nf 4 1\n"}) {
            const ObjTestFiles files({text, text});
            const ObjSequence sequence(files.files());
            const uint32_t first = text.starts_with(odd) ? 1 : 0;
            ASSERT_EQ(sequence.albedo().values.size(), 4u) << text;
            for (uint32_t v = first; v < first + 3; ++v) {
                EXPECT_EQ(sequence.albedo().at(v), Vec3f(1, 0, 0)) << text;
            }
            EXPECT_EQ(files.warnings(sequence).size(), 1 - first) << text;  // the face of two
        }
    }
    const ObjTestFiles files({"v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 2 3 4\n"});
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.albedo().values, Albedo().values);
    EXPECT_TRUE(sequence.warnings().empty());
    EXPECT_FALSE(sequence.vertex_colours().used);
}

TEST(ObjAlbedo, AveragesMaterialsOverTheFacesRoundAVertex) {
    // Vertex 1 has no face. Vertices 2 and 4 see red once and green twice, 3 red, 5 green twice.
    const ObjTestFiles files({"mtllib x.mtl\nv 9 9 9\n" + kFour +
                              "usemtl red\nf 2 3 4\nusemtl green\nf 2 4 5\nf 2 5 4\n"});
    files.add("x.mtl", kRedGreen);
    const ObjSequence sequence(files.files());
    const Vec3f mixed(1.0f / 3.0f, 2.0f / 3.0f, 0);
    EXPECT_EQ(sequence.albedo().values,
              (Values{Albedo().values[0], mixed, {1, 0, 0}, mixed, {0, 1, 0}}));
    EXPECT_TRUE(sequence.warnings().empty());
}

TEST(ObjAlbedo, IsOneValueWhereAllFacesAgree) {
    const ObjTestFiles files(
        {"mtllib none.mtl x.mtl\n" + kFour + "usemtl green\nf 1 2 3\nf 1 3 4\n"});
    files.add("x.mtl", kRedGreen);
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.albedo().values, (Values{{0, 1, 0}}));
    EXPECT_EQ(files.warnings(sequence),
              (std::vector<std::string>{"none.mtl: cannot open: No such file or directory"}));
}

TEST(ObjAlbedo, TakesOneNumberAsGrey) {
    const ObjTestFiles files({"mtllib x.mtl\nusemtl grey\n" + kFour + "f 1 2 3 4\n"});
    files.add("x.mtl", "newmtl grey\nKd +0.5\n");
    EXPECT_EQ(ObjSequence(files.files()).albedo().values, (Values{{0.5f, 0.5f, 0.5f}}));
}

TEST(ObjAlbedo, TellsBlackFromNone) {
    const ObjTestFiles files(
        {"mtllib x.mtl\n" + kFour + "usemtl black\nf 1 2 3\nusemtl none\nf 1 3 4\n"});
    files.add("x.mtl", "newmtl black\nKd 0 0 0\nnewmtl none\nKa 1 1 1\n");
    const Values values = ObjSequence(files.files()).albedo().values;
    EXPECT_EQ(values[1], Vec3f(0, 0, 0));
    EXPECT_EQ(values[3], Albedo().values[0]);
}

TEST(ObjAlbedo, WarnsOnceAboutMissingMaterials) {
    std::string text = "mtllib none.mtl\nmtllib none.mtl\n" + kFour;
    for (int i = 0; i < 50; ++i) text += "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n";
    const ObjTestFiles files({text, text, text});
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.albedo().values, Albedo().values);
    EXPECT_EQ(files.warnings(sequence),
              (std::vector<std::string>{
                  "none.mtl: cannot open: No such file or directory",
                  "0.obj: 2 materials not found in any .mtl file, e.g. 'a'",
              }));
}

TEST(ObjAlbedo, WarnsAboutTexturesAndOddColors) {
    const ObjTestFiles files({"mtllib x.mtl\n" + kFour + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"});
    files.add("x.mtl",
              "newmtl a\nKd 2 1 1\nmap_Kd skin one.png\nnewmtl b\nKd spectral x.rfl\n"
              "map_Kd two.png\nKd 0.5 0.5\n");
    ObjOptions options;
    options.textures = false;
    const ObjSequence sequence(files.files(), options);
    EXPECT_EQ(sequence.albedo().values[1], Vec3f(1, 1, 1));
    EXPECT_EQ(sequence.albedo().values[3], Albedo().values[0]);
    EXPECT_EQ(files.warnings(sequence),
              (std::vector<std::string>{
                  "x.mtl:5: Kd: expected a finite number, got 'spectral'",
                  "x.mtl:7: Kd: expected 3 numbers, got 2",
                  "0.obj: Kd of 1 materials clamped to 0..1",
                  "0.obj: textures are not read: map_Kd of 2 materials, e.g. skin one.png",
              }));
}

}  // namespace
}  // namespace paim
