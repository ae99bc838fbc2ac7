// Names of libraries and materials as exporters write them.
#include "compressor/io/obj_libraries.h"

#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

const std::string kFourVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kRed = "newmtl red\nKd 1 0 0\n";
const Vec3f kRedValue(1, 0, 0), kGreenValue(0, 1, 0);

using Colors = std::vector<Vec3f>;
using Lines = std::vector<std::string>;

// A triangle of `first`, then one of `second`; vertex 1 is of the first alone, vertex 3 of the
// second.
std::string two_materials(const std::string& library, const std::string& first,
                          const std::string& second) {
    return "mtllib " + library + "\n" + kFourVertices + "usemtl " + first + "\nf 1 2 3\nusemtl " +
           second + "\nf 1 3 4\n";
}

class ObjLibrariesTest : public testing::Test {
  protected:
    // The colours of vertices 1 and 3, or of all.
    std::vector<Vec3f> colors(const std::string& text) {
        files_.add("0.obj", text);
        const ObjSequence sequence(files_.files());
        warnings_ = files_.warnings(sequence);
        const std::vector<Vec3f>& values = sequence.albedo().values;
        if (values.size() == 1) return values;
        return {values[1], values[3]};
    }
    // Whether "red" of this library is found, without a word.
    bool finds_red(const std::string& library) {
        return colors("mtllib " + library + "\nusemtl red\n" + kFourVertices + "f 1 2 3 4\n") ==
                   std::vector<Vec3f>{kRedValue} &&
               warnings_.empty();
    }
    ObjTestFiles files_{{""}};
    std::vector<std::string> warnings_;
};

TEST_F(ObjLibrariesTest, FindsLibrariesUnderTheNamesThatExportersWrite) {
    std::filesystem::create_directory(files_.files()[0].parent_path() / "sub");
    for (const char* name : {"my char.mtl", "tab\tin it.mtl", "sub/x.mtl", "sub/two words.mtl",
                             "two  spaces.mtl", "odd\\name.mtl", "no_extension", "#1.mtl"}) {
        files_.add(name, kRed);
    }
    EXPECT_TRUE(finds_red("my char.mtl"));
    EXPECT_TRUE(finds_red(" \tmy char.mtl \t"));
    EXPECT_TRUE(finds_red("my char.mtl\r"));
    EXPECT_TRUE(finds_red("\"my char.mtl\""));
    EXPECT_TRUE(finds_red("'my char.mtl'"));
    EXPECT_TRUE(finds_red("tab\tin it.mtl"));
    EXPECT_TRUE(finds_red("two  spaces.mtl"));
    EXPECT_TRUE(finds_red("sub/x.mtl"));
    EXPECT_TRUE(finds_red("./sub/x.mtl"));
    EXPECT_TRUE(finds_red("sub\\x.mtl"));
    EXPECT_TRUE(finds_red(".\\sub\\two words.mtl"));
    EXPECT_TRUE(finds_red("\"sub\\two words.mtl\""));
    EXPECT_TRUE(finds_red("odd\\name.mtl"));  // as written comes first
    EXPECT_TRUE(finds_red("no_extension"));
    EXPECT_TRUE(finds_red("#1.mtl"));
    EXPECT_TRUE(finds_red("my char.mtl # exported"));
    // A path of the machine that wrote the file: the library lies next to it.
    EXPECT_TRUE(finds_red("C:\\Users\\me\\my char.mtl"));
    EXPECT_TRUE(finds_red("/nowhere/at all/my char.mtl"));
}

// Windows takes both for the same file.
TEST_F(ObjLibrariesTest, FindsLibrariesInOtherCase) {
    const auto folder = files_.files()[0].parent_path();
    std::filesystem::create_directories(folder / "Sub");
    for (const char* name : {"My Char.mtl", "Sub/X.MTL", "other.mtl"}) files_.add(name, kRed);
    const auto takes = [&](const std::string& file, const std::string& library) {
        return !finds_red(library) &&
               warnings_ == Lines{file + ": taken for the material library '" + library + "'"} &&
               ObjSequence(files_.files()).albedo().values == Colors{kRedValue};
    };
    EXPECT_TRUE(takes("My Char.mtl", "my char.mtl"));
    EXPECT_TRUE(takes("My Char.mtl", "MY CHAR.MTL"));
    EXPECT_TRUE(takes("My Char.mtl", "\"MY CHAR.MTL\""));
    EXPECT_TRUE(takes("My Char.mtl", "C:\\Me\\My char.MTL"));
    EXPECT_TRUE(takes("My Char.mtl", "/nowhere/at all/MY char.mtl"));
    EXPECT_TRUE(takes("Sub/X.MTL", "sub/x.mtl"));
    EXPECT_TRUE(takes("./Sub/X.MTL", ".\\sub\\x.mtl"));
    EXPECT_TRUE(takes("Sub/X.MTL", "Sub/x.MTL"));
    // Several on a line.
    files_.add("green.Mtl", "newmtl green\nKd 0 1 0\n");
    EXPECT_EQ(colors(two_materials("MY char.mtl GREEN.mtl", "red", "green")),
              (Colors{kRedValue, kGreenValue}));
    EXPECT_EQ(warnings_.size(), 2u);
    // A file of the very name comes first, without a word. Two others are as good as none.
    files_.add("other.MTL", "newmtl red\nKd 0 0 1\n");
    EXPECT_TRUE(finds_red("other.mtl"));
    EXPECT_FALSE(finds_red("Other.mtl"));
    EXPECT_EQ(warnings_[0], "Other.mtl: cannot open: No such file or directory");
    // No folder is a library.
    std::filesystem::create_directory(folder / "Folder.mtl");
    EXPECT_FALSE(finds_red("folder.mtl"));
    EXPECT_EQ(warnings_[0], "folder.mtl: cannot open: No such file or directory");
}

TEST_F(ObjLibrariesTest, ReadsAllLibrariesOfALine) {
    files_.add("a.mtl", kRed);
    files_.add("b c.mtl", "newmtl green\nKd 0 1 0\n");
    for (const char* line : {"a.mtl b c.mtl", "b c.mtl  a.mtl", "a.mtl \"b c.mtl\"",
                             "a.mtl\nmtllib b c.mtl", "a.mtl b c.mtl # both"}) {
        EXPECT_EQ(colors(two_materials(line, "red", "green")), (Colors{kRedValue, kGreenValue}))
            << line;
        EXPECT_EQ(warnings_, Lines{}) << line;
    }
    // Of a name that is not there, the others are read all the same.
    EXPECT_EQ(colors(two_materials("no ne.mtl a.mtl b c.mtl", "red", "green")),
              (Colors{kRedValue, kGreenValue}));
    EXPECT_EQ(warnings_, (Lines{"no ne.mtl: cannot open: No such file or directory"}));
}

TEST_F(ObjLibrariesTest, NamesLibrariesThatAreMissing) {
    colors(two_materials("my char.mtl", "red", "green"));
    EXPECT_EQ(warnings_, (Lines{"my char.mtl: cannot open: No such file or directory",
                                "0.obj: 2 materials not found in any .mtl file, e.g. 'red'"}));
    colors(two_materials("C:\\x\\my char.mtl", "red", "red"));
    EXPECT_EQ(warnings_[0], "C:\\x\\my char.mtl: cannot open: No such file or directory");
}

TEST_F(ObjLibrariesTest, KeepsMaterialsThatShareAWordApart) {
    files_.add("x.mtl", "newmtl skin\nKd 1 0 0\nnewmtl skin body\nKd 0 1 0\n");
    EXPECT_EQ(colors(two_materials("x.mtl", "skin", "skin body")),
              (Colors{kRedValue, kGreenValue}));
    EXPECT_EQ(colors(two_materials("x.mtl", "skin body", "skin")),
              (Colors{kGreenValue, kRedValue}));
    EXPECT_EQ(warnings_, Lines{});
    // One that is not there is not taken for one that is.
    EXPECT_EQ(colors(two_materials("x.mtl", "skin", "skin arm"))[1], Albedo().values[0]);
    EXPECT_EQ(warnings_, (Lines{"0.obj: 1 materials not found in any .mtl file, e.g. 'skin arm'"}));
    files_.add("x.mtl", "newmtl Mat #1\nKd 1 0 0\nnewmtl Mat #2\nKd 0 1 0\n");
    EXPECT_EQ(colors(two_materials("x.mtl", "Mat #1", "Mat #2")), (Colors{kRedValue, kGreenValue}));
    EXPECT_EQ(colors(two_materials("x.mtl", "Mat #1", "Mat #3"))[1], Albedo().values[0]);
}

TEST_F(ObjLibrariesTest, FindsMaterialsUnderTheNamesThatExportersWrite) {
    files_.add("x.mtl", "\tnewmtl  a b \r\nKd 1 0 0\r\nnewmtl \"c\td\"\nKd 0 1 0 # x\n");
    for (const char* name : {"a b", "a\tb", " a  b\t", "\"a b\"", "a b # c", "a b\r"}) {
        EXPECT_EQ(colors(two_materials("x.mtl", name, "c d")), (Colors{kRedValue, kGreenValue}))
            << name;
        EXPECT_EQ(warnings_, Lines{}) << name;
    }
    files_.add("x.mtl", "newmtl red # the first\nKd 1 0 0\nnewmtl a\\b\nKd 0 1 0\n");
    EXPECT_EQ(colors(two_materials("x.mtl", "red", "a\\b")), (Colors{kRedValue, kGreenValue}));
    // The first of two of the same name counts, and libraries may follow their use.
    files_.add("x.mtl", kRed + "newmtl red\nKd 0 0 1\nnewmtl green\nKd 0 1 0\n");
    EXPECT_EQ(colors(kFourVertices + "usemtl red\nf 1 2 3\nusemtl green\nf 1 3 4\nmtllib x.mtl\n"),
              (Colors{kRedValue, kGreenValue}));
}

}  // namespace
}  // namespace paim
