// Gloss of material libraries and of options.
#include "compressor/io/obj_gloss.h"

#include "compressor/material/brdfs.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kPlastic = "newmtl plastic\nKd 0.2 0.2 0.2\nKs 0.5 0.25 0.5\nNs 32\nillum 2\n";
const std::string kMatte = "newmtl matte\nKd 0.2 0.2 0.2\nKs 0 0 0\nNs 32\n";

using Lines = std::vector<std::string>;
using Numbers = std::vector<uint16_t>;

// One file with a library "x.mtl".
struct GlossyFiles : ObjTestFiles {
    GlossyFiles(const std::string& library, const std::string& faces,
                const std::string& vertices = kQuad)
        : ObjTestFiles({"mtllib x.mtl\n" + vertices + faces}) {
        add("x.mtl", library);
    }
};

ObjOptions with_gloss(const Lines& overrides = {}, bool from_libraries = true) {
    ObjOptions options;
    options.gloss.from_libraries = from_libraries;
    for (const std::string& text : overrides) {
        options.gloss.overrides.push_back(parse_gloss_override(text));
    }
    return options;
}

// The gloss of a mesh whose only material has these lines and no diffuse reflection.
Materials gloss_of(const std::string& lines, Lines* warnings = nullptr) {
    const GlossyFiles files("newmtl a\nKd 0\n" + lines, "usemtl a\nf 1 2 3 4\n");
    const ObjSequence sequence(files.files(), with_gloss());
    if (warnings != nullptr) *warnings = files.warnings(sequence);
    return sequence.materials();
}

TEST(ObjGloss, IsReadOnlyWhereItIsAskedFor) {
    const GlossyFiles files(kPlastic + kMatte, "usemtl plastic\nf 1 2 3\nusemtl matte\nf 1 3 4\n");
    const ObjSequence plain(files.files());
    EXPECT_TRUE(plain.materials().empty());
    ASSERT_EQ(plain.notes().size(), 1u);
    EXPECT_EQ(files.shortened(plain.notes()[0]),
              "0.obj: 1 materials are glossy, e.g. 'plastic', and baked as matte: --gloss takes "
              "their gloss, --material sets another");
    const ObjSequence glossy(files.files(), with_gloss());
    ASSERT_EQ(glossy.materials().glossy.size(), 1u);
    EXPECT_EQ(glossy.materials().glossy[0].brdf, "phong:0.5,32");
    EXPECT_EQ(glossy.materials().glossy[0].tint, Vec3f(1, 0.5f, 1));
    EXPECT_TRUE(glossy.notes().empty());
    EXPECT_TRUE(glossy.warnings().empty());
    // The diffuse bake does not change by a note.
    EXPECT_EQ(plain.albedo().values, glossy.albedo().values);
}

TEST(ObjGloss, NoNoteNamesMaterialsThatNoFaceHas) {
    const GlossyFiles files(kPlastic + kMatte, "usemtl plastic\nusemtl matte\nf 1 2 3 4\n");
    EXPECT_TRUE(ObjSequence(files.files()).notes().empty());
}

TEST(ObjGloss, TellsGlossyMaterialsFromMatteOnes) {
    EXPECT_EQ(gloss_of("Ks 0.5\nNs 10\n").glossy[0].brdf, "phong:0.5,10");
    EXPECT_EQ(gloss_of("Ks 0.5\nNs 10\nillum 2\n").glossy[0].brdf, "phong:0.5,10");
    for (const char* matte : {"Ks 0.5\nNs 10\nillum 0\n", "Ks 0.5\nNs 10\nillum 1\n",
                              "Ks 0 0 0\nNs 10\n", "Ks 0.5\n", "Ns 10\n", "Ks -1 0 0\nNs 10\n"}) {
        const Materials materials = gloss_of(matte);
        EXPECT_TRUE(materials.empty()) << matte;
        EXPECT_EQ(materials.of_vertex, Numbers{0}) << matte;
    }
}

TEST(ObjGloss, ClampsWithAWarning) {
    Lines warnings;
    EXPECT_EQ(gloss_of("Ks 2 1 0\nNs 1e6\n", &warnings).glossy[0].brdf, "phong:1,10000");
    const std::string clamped =
        "0.obj: gloss of 1 materials clamped: Ks and Pm to 0..1, Ns to 1..10000, Pr to 0.02..1";
    EXPECT_EQ(warnings, Lines{clamped});
    EXPECT_EQ(gloss_of("Ks 1\nNs 0\n", &warnings).glossy[0].brdf, "phong:1,1");
    EXPECT_EQ(warnings, Lines{clamped});
    EXPECT_EQ(gloss_of("Pr 0\nPm 0\n", &warnings).glossy[0].brdf, "cook-torrance:0.04,0.02");
    EXPECT_EQ(warnings, Lines{clamped});
    EXPECT_EQ(gloss_of("Pr 1\nPm 0\n", &warnings).glossy[0].brdf, "cook-torrance:0.04,1");
    EXPECT_TRUE(warnings.empty());
}

// The ends of the ranges are those of the BRDFs: they take what is clamped, and no more.
TEST(ObjGloss, ClampsToTheRangesOfTheBrdfs) {
    for (const char* end :
         {"phong:0,1", "phong:1,10000", "cook-torrance:0,0.02", "cook-torrance:1,1"}) {
        EXPECT_NO_THROW(parse_brdf(end)) << end;
    }
    for (const char* beyond : {"phong:1,0.99", "phong:1,10001", "phong:1.01,5",
                               "cook-torrance:1,0.019", "cook-torrance:1,1.01"}) {
        EXPECT_THROW(parse_brdf(beyond), Error) << beyond;
    }
}

TEST(ObjGloss, MetalsReflectTheirColourAndKeepNoneOfIt) {
    const GlossyFiles files(
        "newmtl gold\nKd 0.8 0.4 0\nPr 0.3\nPm 1\nnewmtl half\nKd 0.8 0.4 0\nPr 0.3\nPm 0.5\n",
        "usemtl gold\nf 1 2 3\nusemtl half\nf 5 6 7\n", kQuad + "v 0 0 1\nv 1 0 1\nv 1 1 1\n");
    const ObjSequence sequence(files.files(), with_gloss());
    const Materials& materials = sequence.materials();
    ASSERT_EQ(materials.glossy.size(), 2u);
    EXPECT_EQ(materials.glossy[0].brdf, "cook-torrance:0.8,0.3");
    EXPECT_EQ(materials.glossy[0].tint, Vec3f(1, 0.5f, 0));
    // 0.04 · 0.5 + 0.8 · 0.5, and the tint relative to it.
    EXPECT_EQ(materials.glossy[1].brdf, "cook-torrance:0.42,0.3");
    EXPECT_TRUE(materials.glossy[1].tint.isApprox(Vec3f(1, 0.22f / 0.42f, 0.02f / 0.42f), 1e-6f));
    EXPECT_EQ(sequence.albedo().at(0), Vec3f(0, 0, 0));
    EXPECT_TRUE(sequence.albedo().at(5).isApprox(Vec3f(0.4f, 0.2f, 0), 1e-6f));
    // Without --gloss the albedo is Kd, as it is for any other material.
    EXPECT_EQ(ObjSequence(files.files()).albedo().at(0), Vec3f(0.8f, 0.4f, 0));
    EXPECT_EQ(materials.of_vertex, (Numbers{1, 1, 1, 0, 2, 2, 2}));
    Lines warnings;
    EXPECT_TRUE(gloss_of("Pm 1\n", &warnings).empty());
    EXPECT_EQ(warnings, Lines{"0.obj: Pm of 1 materials ignored, as they have no Pr"});
}

// What is left of Kd goes with the gloss of the library: where an option sets another, all of it is
// there, as without --gloss.
TEST(ObjGloss, MetalsWhoseGlossIsReplacedKeepTheirColour) {
    const GlossyFiles files(
        "newmtl gold\nKd 0.8 0.4 0\nPr 0.3\nPm 1\nnewmtl other\nKd 0.8 0.4 0\nPr 0.3\nPm 1\n",
        "usemtl gold\nf 1 2 3\nusemtl other\nf 5 6 7\n", kQuad + "v 0 0 1\nv 1 0 1\nv 1 1 1\n");
    const auto colours = [&](const Lines& overrides) {
        const ObjSequence sequence(files.files(), with_gloss(overrides));
        return std::pair(sequence.albedo().at(0), sequence.albedo().at(5));
    };
    const Vec3f whole(0.8f, 0.4f, 0), none(0, 0, 0);
    EXPECT_EQ(colours({}), std::pair(none, none));
    EXPECT_EQ(colours({"gold=matte"}), std::pair(whole, none));
    EXPECT_EQ(colours({"gold=phong:0.1,5"}), std::pair(whole, none));
    EXPECT_EQ(colours({"matte"}), std::pair(whole, whole));
}

TEST(ObjGloss, DamagedLinesWarnOnlyWhereTheyCount) {
    const GlossyFiles files("newmtl a\nKs spectral x.rfl\nNs\nPr x\n", "usemtl a\nf 1 2 3 4\n");
    EXPECT_TRUE(ObjSequence(files.files()).warnings().empty());
    EXPECT_EQ(files.warnings(ObjSequence(files.files(), with_gloss())),
              (Lines{"x.mtl:2: Ks: expected a finite number, got 'spectral'",
                     "x.mtl:3: Ns: expected a number, got none",
                     "x.mtl:4: Pr: expected a finite number, got 'x'"}));
}

TEST(ObjGloss, OptionsCountBeforeLibraries) {
    const GlossyFiles files(kPlastic + kMatte, "usemtl plastic\nf 1 2 3\nusemtl matte\nf 5 6 7\n",
                            kQuad + "v 0 0 1\nv 1 0 1\nv 1 1 1\n");
    const auto brdfs = [&](const Lines& overrides, bool from_libraries) {
        const ObjSequence sequence(files.files(), with_gloss(overrides, from_libraries));
        EXPECT_TRUE(sequence.notes().empty());
        Lines of_faces;
        for (const uint32_t v : {0u, 4u}) {
            const uint16_t m = sequence.materials().at(v);
            of_faces.push_back(m > 0 ? sequence.materials().glossy[m - 1u].brdf : "matte");
        }
        return of_faces;
    };
    const std::string phong = "phong:0.5,32", rough = "cook-torrance:0.5,0.7";
    EXPECT_EQ(brdfs({}, true), (Lines{phong, "matte"}));
    EXPECT_EQ(brdfs({rough}, true), (Lines{rough, rough}));
    EXPECT_EQ(brdfs({rough}, false), (Lines{rough, rough}));
    EXPECT_EQ(brdfs({"matte=" + rough}, false), (Lines{"matte", rough}));
    EXPECT_EQ(brdfs({"matte=" + rough}, true), (Lines{phong, rough}));
    EXPECT_EQ(brdfs({"plastic=matte"}, true), (Lines{"matte", "matte"}));
    EXPECT_EQ(brdfs({"matte=" + rough, "phong:1,2"}, true), (Lines{"phong:1,2", rough}));
    EXPECT_EQ(brdfs({"phong:1,2", "matte=" + rough}, true), (Lines{"phong:1,2", rough}));
    EXPECT_EQ(brdfs({"phong:1,2", "phong:1,3"}, false), (Lines{"phong:1,3", "phong:1,3"}));
}

TEST(ObjGloss, EqualMaterialsAreKeptOnce) {
    const GlossyFiles files(kPlastic + "newmtl other\nKd 1 0 0\nKs 0.5 0.25 0.5\nNs 32\n",
                            "usemtl plastic\nf 1 2 3\nusemtl other\nf 1 3 4\n");
    const ObjSequence sequence(files.files(), with_gloss());
    EXPECT_EQ(sequence.materials().glossy.size(), 1u);
    EXPECT_EQ(sequence.materials().of_vertex, Numbers{1});
}

TEST(ObjGloss, NamesThatNoFaceHasAreRefused) {
    const GlossyFiles files(kPlastic, "usemtl plastic\nf 1 2 3 4\n");
    try {
        ObjSequence(files.files(), with_gloss({"plasic=matte"}));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_EQ(files.shortened(error.what()),
                  "--material: no face of 0.obj has the material 'plasic', expected 'plastic'");
    }
    // Without any library the names of usemtl lines count.
    const ObjTestFiles bare({kQuad + "usemtl odd = name\nf 1 2 3 4\n"});
    const ObjSequence sequence(bare.files(), with_gloss({"odd = name=phong:1,5"}, false));
    EXPECT_EQ(sequence.materials().glossy.at(0).brdf, "phong:1,5");
}

TEST(ObjGloss, ColoursOfVerticesAndOptionsLeaveGlossAlone) {
    const std::string colored = "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\n";
    const GlossyFiles files(kPlastic, "usemtl plastic\nf 1 2 3\n", colored);
    EXPECT_TRUE(ObjSequence(files.files()).notes().empty());  // the library is not read
    EXPECT_EQ(ObjSequence(files.files(), with_gloss()).materials().glossy.size(), 1u);
    ObjOptions options = with_gloss();
    options.albedo = Vec3f(0.1f, 0.2f, 0.3f);
    const ObjSequence sequence(files.files(), options);
    EXPECT_EQ(sequence.materials().glossy.size(), 1u);
    EXPECT_EQ(sequence.albedo().values, (std::vector<Vec3f>{{0.1f, 0.2f, 0.3f}}));
}

TEST(ObjGloss, OptionsThatAreNoMaterialAreRefused) {
    const auto message = [](const std::string& text) {
        try {
            parse_gloss_override(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
            return std::string(error.what());
        }
        return std::string("no error");
    };
    for (const char* text :
         {"phong", "phong:1", "phong:2,5", "shiny", "", "a=", "=matte", "a=b=c"}) {
        EXPECT_TRUE(message(text).starts_with(std::string("--material ") + text + ": ")) << text;
    }
    const GlossChoice::Override skin = parse_gloss_override("a=b=phong:0.50,32.0");
    EXPECT_EQ(skin.material, "a=b");
    EXPECT_EQ(skin.brdf, "phong:0.5,32");
}

}  // namespace
}  // namespace paim
