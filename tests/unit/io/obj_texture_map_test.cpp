// What map_Kd lines say.
#include "compressor/io/obj_texture_map.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

TEST(ObjTextureMap, NamesAreTheRestOfTheLine) {
    for (const char* name : {"a.png", "my skin.png", "C:\\tex\\a b.jpg", "-odd.png", "2.png"}) {
        const ObjTextureMap map = parse_texture_map(name);
        EXPECT_EQ(map.file, name);
        EXPECT_EQ(map.scale, Vec2f(1, 1)) << name;
        EXPECT_EQ(map.offset, Vec2f(0, 0)) << name;
        EXPECT_EQ(map.ignored, "") << name;
    }
    EXPECT_EQ(parse_texture_map("").file, "");
    EXPECT_EQ(parse_texture_map("-s 1 1 1").file, "1");  // the last word is always the name
}

TEST(ObjTextureMap, OptionsMoveTheImage) {
    const ObjTextureMap map = parse_texture_map("-s 2 0.5 1 -o +0.25\t-1e-1 0  skin 1.png");
    EXPECT_EQ(map.file, "skin 1.png");
    EXPECT_EQ(map.scale, Vec2f(2, 0.5f));
    EXPECT_EQ(map.offset, Vec2f(0.25f, -0.1f));
    EXPECT_EQ(map.ignored, "");
    // Numbers that are left out.
    EXPECT_EQ(parse_texture_map("-s 2 a.png").scale, Vec2f(2, 1));
    EXPECT_EQ(parse_texture_map("-o 0.5 a.png").offset, Vec2f(0.5f, 0));
    EXPECT_EQ(parse_texture_map("-s 1e9 a.png").file, "1e9 a.png");
}

TEST(ObjTextureMap, OptionsThatMatterAreNamed) {
    for (const char* line :
         {"-clamp on a.png", "-mm 0 2 a.png", "-t 1 1 1 a.png", "-cc on a.png"}) {
        const ObjTextureMap map = parse_texture_map(line);
        EXPECT_EQ(map.file, "a.png") << line;
        EXPECT_EQ(map.ignored, std::string(line).substr(0, std::string(line).find(' '))) << line;
    }
    for (const char* line : {"-clamp off a.png", "-blendu on -blendv off a.png",
                             "-texres 512 a.png", "-bm 1 -boost 3 a.png", "-imfchan m a.png"}) {
        const ObjTextureMap map = parse_texture_map(line);
        EXPECT_EQ(map.file, "a.png") << line;
        EXPECT_EQ(map.ignored, "") << line;
    }
}

}  // namespace
}  // namespace paim
