// Materials that reflect more light than arrives are named before a bake.
#include "compressor/io/obj_reflectance.h"

#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

const std::string kTwoFaces =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\n"
    "usemtl a\nf 1 2 3\nusemtl b\nf 4 5 6\n";

using Lines = std::vector<std::string>;

Lines warnings_of(const std::string& library, const Lines& overrides = {},
                  std::optional<Vec3f> albedo = {}, const std::string& faces = kTwoFaces) {
    ObjTestFiles files({"mtllib x.mtl\n" + faces});
    files.add("x.mtl", library);
    ObjOptions options;
    options.gloss.from_libraries = true;
    options.albedo = albedo;
    for (const std::string& text : overrides) {
        options.gloss.overrides.push_back(parse_gloss_override(text));
    }
    return files.warnings(ObjSequence(files.files(), options));
}

std::string too_bright(const std::string& subject, const std::string& sum) {
    return "0.obj: " + subject + " more light than arrives: expected at most 1 of " + sum +
           ". With --bounces the light grows at every bounce";
}

// Phong's ks is the share at normal incidence.
TEST(ObjReflectance, NamesTheMaterialAndTheChannel) {
    EXPECT_EQ(warnings_of("newmtl a\nKd 0.2 0.7 0.5\nKs 0.5 0.4 0.5\nNs 32\n"
                          "newmtl b\nKd 0.5\nKs 0.5\nNs 32\n"),
              Lines{too_bright("the material 'a' reflects",
                               "green, got 1.1 (0.7 diffuse and 0.4 glossy)")});
}

TEST(ObjReflectance, CountsWhatOptionsSet) {
    const std::string library = "newmtl a\nKd 0.7\nKs 0.6\nNs 9\nnewmtl b\nKd 0.3\n";
    EXPECT_EQ(warnings_of(library).size(), 1u);
    EXPECT_EQ(warnings_of(library, {"a=matte"}), Lines());
    EXPECT_EQ(warnings_of(library, {}, Vec3f(0.4f, 0.3f, 0.4f)), Lines());
    EXPECT_EQ(warnings_of(library, {"a=matte", "b=phong:0.75,4"}),
              Lines{too_bright("the material 'b' reflects",
                               "red, got 1.05 (0.3 diffuse and 0.75 glossy)")});
    EXPECT_EQ(warnings_of("", {"phong:0.5,4"}, Vec3f(0.5f, 0.5f, 0.75f),
                          "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"),
              Lines{too_bright("faces without a material reflect",
                               "blue, got 1.25 (0.75 diffuse and 0.5 glossy)")});
}

// A vertex between two materials has the mean of their colours, which is neither's own.
TEST(ObjReflectance, CountsTheColourOfFacesAndNotOfVertices) {
    const std::string sheet =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n";
    EXPECT_EQ(warnings_of("newmtl a\nKd 0.2\nKs 0.6\nNs 9\nnewmtl b\nKd 1\n", {}, {}, sheet),
              Lines());
}

// Metals keep none of their colour; what is reflected at normal incidence is at most F0.
TEST(ObjReflectance, MetalsReflectNoMoreThanArrives) {
    EXPECT_EQ(warnings_of("newmtl a\nKd 1\nPr 0.3\nPm 1\nnewmtl b\nKd 0.96\nPr 0.3\n"), Lines());
    EXPECT_EQ(warnings_of("newmtl a\nKd 1\nPr 0.3\nnewmtl b\nKd 0.9\n").size(), 1u);
}

}  // namespace
}  // namespace paim
