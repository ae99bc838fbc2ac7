// The strict check: what it takes, what it refuses and in which words, and the text that it leaves.
#include "compressor/io/obj_scan.h"

#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ObjScan, TakesTheFormsThatFilesUse) {
    const ObjScan expected = scan_text(kTriangleObj);
    EXPECT_EQ(expected.num_vertices, 3u);
    EXPECT_EQ(expected.faces.sizes, (std::vector<uint32_t>{3}));
    EXPECT_EQ(expected.faces.corners, (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_FALSE(expected.has_colors);
    for (const std::string text : {
             "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",              // CRLF
             "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",                        // CR, no end
             "# x\n\n \t\nv\t0 0 0 \n  v 1 0 0 # y\nv 0 1 0\nf 1 2 3\n",  // blank, tabs, comments
             "v 0 0 \\\n 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n2\\\n 3\n",       // continued lines
             "\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",          // byte-order mark
             "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n",                      // faces first
             "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n",                   // relative
             "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 0.5\nf 1 2 3\n",              // w
             "vt 0 0\nvn 0 0 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2//1 3/-1\n",
             "v -.5 +1e2 5.\nv 1E-3 00 0.0\nv 1e-9999 3.4e38 -0\nf 1 2 3\n",
             "o a b\ng c\ns off\nusemtl x y\nmtllib z.mtl\nvp 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 "
             "3",
         }) {
        EXPECT_EQ(bad_input_of([&] { EXPECT_EQ(scan_text(text).faces, expected.faces) << text; }),
                  "no error")
            << text;
        std::string whole = text, again = text;
        EXPECT_EQ(scan_positions("x", again),
                  scan_obj("x", whole, {.read_positions = true}).positions)
            << text;
    }
}

TEST(ObjScan, ReadsColorsWhereTheyAreWanted) {
    std::string text = "v 0 0 0 1 0 0.1\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 9 9 9\nf 1 2 3\n";
    std::string again = text, mixed = "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
    EXPECT_EQ(scan_obj("x", text, {.read_colors = true}).colors,
              (std::vector<Vec3d>{{1, 0, 0.1}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}));
    EXPECT_TRUE(scan_obj("x", again).colors.empty());
    EXPECT_TRUE(scan_obj("x", mixed, {.read_colors = true}).colors.empty());
}

TEST(ObjScan, SeesColorsOnlyIfAllHaveThem) {
    EXPECT_TRUE(scan_text("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n").has_colors);
    EXPECT_FALSE(scan_text("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n").has_colors);
    EXPECT_FALSE(scan_text("v 0 0 0 1 0 0\nv 1 0 0 1\nv 0 1 0 0 0 1\nf 1 2 3\n").has_colors);
}

TEST(ObjScan, CountsWhatItLeavesOut) {
    const ObjScan scan = scan_text(kThree + "f\nf 1\nf 1 2\np 1 2 3\nl 1 99\nl x\nf 1 2 3\n");
    EXPECT_EQ(scan.num_small_faces, 3u);
    EXPECT_EQ(scan.num_other_shapes, 3u);
    EXPECT_EQ(scan.faces.num_faces(), 1u);
}

TEST(ObjScan, LeavesCleanText) {
    std::string text = "\xEF\xBB\xBF#\nv 0 0 0#9\n";  // '#9' is no comment: part of the word
    EXPECT_EQ(scan_error(text), "x.obj:2: vertex coordinate: expected a finite number, got '0#9'");
    text = "v 0e999 1e-99 \\\r\n-1 # x\nvn 1 2 3\nt 9 9\nvt 1\nf 1\nf 1 1 1 #\n";
    scan_obj("x.obj", text);
    EXPECT_EQ(text, "v 0     0        -1    \nvn      \n# 9 9\nvt  \n# 1\nf 1 1 1  \n");
}

TEST(ObjScan, RefusesCoordinatesThatAreNoFiniteNumbers) {
    const auto error_of = [](const std::string& word) {
        return scan_error("# first\nv 0 " + word + " 0\n");
    };
    for (const std::string word : {"nan", "-nan", "inf", "1.#IND", "1,5", "0x10", "1e", "1e+", "-",
                                   "+", ".", "+-1", "--1", "1-", "a", "1_0", "\\", "infinity"}) {
        EXPECT_EQ(error_of(word),
                  "x.obj:2: vertex coordinate: expected a finite number, got '" + word + "'");
    }
    const std::string digits(39, '9');
    for (const std::string& word : {std::string("1e39"), std::string("-3.5e38"), digits,
                                    std::string("1e400"), std::string("1e99999999999999999999")}) {
        EXPECT_EQ(error_of(word),
                  "x.obj:2: vertex coordinate: expected a number from -3.4e38 to 3.4e38, got '" +
                      word + "'");
    }
    EXPECT_EQ(error_of("\x01_\xff"),
              "x.obj:2: vertex coordinate: expected a finite number, got '?_?'");
    EXPECT_EQ(scan_error("v 1 2\n"), "x.obj:1: vertex coordinate: expected 3 numbers, got 2");
    EXPECT_EQ(scan_error("v 1 2 \\\n\nv 1 2 3\n"),
              "x.obj:2: vertex coordinate: expected 3 numbers, got 2");
    EXPECT_EQ(scan_error("v 1 2 3 nan\n"),
              "x.obj:1: vertex attribute: expected a finite number, got 'nan'");
    EXPECT_EQ(scan_error("v 1 2 \\\n3 x\n"),
              "x.obj:2: vertex attribute: expected a finite number, got 'x'");
}

TEST(ObjScan, RefusesIndicesOutOfRange) {
    const auto error_of = [](const std::string& face) { return scan_error(kThree + face + "\n"); };
    EXPECT_EQ(error_of("f 1 2 4"), "x.obj:4: face index 4 is out of range: expected 1 to 3");
    EXPECT_EQ(error_of("f 1 2 3\nf 1 9000 3\nf 1 2 4"),
              "x.obj:5: face index 9000 is out of range: expected 1 to 3");
    EXPECT_EQ(error_of("f 0 1 2"), "x.obj:4: face index 0 is out of range: expected 1 or more");
    EXPECT_EQ(error_of("f -4 1 2"), "x.obj:4: face index -4 is out of range: expected -3 to -1");
    EXPECT_EQ(scan_error("f -1 1 2\n" + kThree),
              "x.obj:1: face index -1 is out of range: none precedes this line");
    for (const std::string index : {"99999999999999999999", "4294967297", "2147483648"}) {
        EXPECT_EQ(error_of("f 1 2 " + index),
                  "x.obj:4: face index " + index + " is out of range: expected at most 2147483647");
    }
    EXPECT_EQ(error_of("f -99999999999999999999 1 2"),
              "x.obj:4: face index -99999999999999999999 is out of range: expected -3 to -1");
    EXPECT_EQ(error_of("f 1/0 2 3"),
              "x.obj:4: texture coordinate index 0 is out of range: expected 1 or more");
    EXPECT_EQ(error_of("f 1//0 2 3"),
              "x.obj:4: normal index 0 is out of range: expected 1 or more");
    EXPECT_EQ(error_of("f 1/9/9 2 3"), "no error");  // not used, so of no matter
}

TEST(ObjScan, RefusesCornersOfNoKnownForm) {
    const auto error_of = [](const std::string& face) { return scan_error(kThree + face + "\n"); };
    EXPECT_EQ(error_of("f 1 x 3"), "x.obj:4: face index: expected an integer, got 'x'");
    EXPECT_EQ(error_of("f 1 2/ 3"),
              "x.obj:4: texture coordinate index: expected an integer, got ''");
    EXPECT_EQ(error_of("f 1 2// 3"), "x.obj:4: normal index: expected an integer, got ''");
    for (const std::string word : {"2.5", "2/1/1/1", "2x", "2//1/", "2#"}) {
        EXPECT_EQ(error_of("vt 0 0\nf 1 " + word + " 3"),
                  "x.obj:5: face corner: expected v, v/vt, v//vn or v/vt/vn, got '" + word + "'");
    }
}

TEST(ObjScan, TakesManyCorners) {
    std::string face = "f";
    for (int i = 0; i < 1000000; ++i) face += " 1";
    EXPECT_EQ(scan_text(kThree + face).faces.sizes, (std::vector<uint32_t>{1000000}));
    EXPECT_EQ(scan_error(kThree + face + " 1"), "x.obj:4: face: expected at most 1000000 vertices");
}

TEST(ObjScan, ReadsMaterialLinesWhereTheyAreWanted) {
    const std::string text = "mtllib a b.mtl\t\n" + kThree +
                             "f 1 2 3\nusemtl skin body \nf 1 2 3\nusemtl\tskin\r\nf 1\nf 1 3 2\n"
                             "usemtl skin body\nf 2 3 1\nmtllib sub\\x.mtl\n";
    const ObjScan scan = scan_text(text, {false, nullptr, false, true});
    EXPECT_EQ(scan.libraries, (std::vector<std::string>{"a b.mtl", "sub\\x.mtl"}));
    EXPECT_EQ(scan.materials, (std::vector<std::string>{"skin body", "skin"}));
    EXPECT_EQ(scan.face_materials, (std::vector<int32_t>{-1, 0, 1, 0}));
    EXPECT_TRUE(scan_text(text).face_materials.empty());
}

TEST(ObjScan, RefusesFilesWithoutAMesh) {
    EXPECT_EQ(scan_error(""), "x.obj: no vertices");
    EXPECT_EQ(scan_error("# nothing\n"), "x.obj: no vertices");
    EXPECT_EQ(scan_error(kThree), "x.obj: no faces");
    EXPECT_EQ(scan_error(kThree + "f 1 2\nl 1 2 3\n"), "x.obj: no faces");
    EXPECT_EQ(scan_error(kTriangleObj + std::string(1, '\0')),
              "x.obj: expected text, got a zero byte at offset 32");
}

TEST(ObjScan, ComparesWithTheReference) {
    const ObjScan first = scan_text(kThree + "f 1 2 3\nf 3 2 1\n");
    const ObjReference reference{"0.obj", first};
    const auto error_of = [&](const std::string& text) {
        return scan_error(text, {false, &reference});
    };
    EXPECT_EQ(error_of("v 9 9 9\n\nv 9 9 9\nv 9 9 9\nf -3 -2 -1\nf 3/1 2/1 1/1\n"), "no error");
    EXPECT_EQ(error_of("v 0 0 0\nf 1 2 3\n"), "x.obj: 1 vertices, expected 3 (as in 0.obj)");
    EXPECT_EQ(error_of(kThree + "f 1 2 3\n"), "x.obj: 1 faces, expected 2 (as in 0.obj)");
    EXPECT_EQ(error_of(kThree + "f 1 2 3\nf 1 3 2\n"),
              "x.obj:5: face 2 is '1 3 2', expected '3 2 1' (as in 0.obj)");
    EXPECT_EQ(error_of(kThree + "f 1 2 3 1\nf 3 2 1\n"),
              "x.obj:4: face 1 is '1 2 3 1', expected '1 2 3' (as in 0.obj)");
    EXPECT_EQ(error_of(kThree + "f 1 2 3\nf 3 2 1 1 1 1 1 1 1 1\n"),
              "x.obj:5: face 2 is '3 2 1 1 1 1 1 1 ... (10 vertices)', expected '3 2 1' (as in "
              "0.obj)");
}

TEST(ObjScan, ChecksNormalsOnlyWhereTheyAreUsed) {
    const ObjScanOptions with_normals{true, nullptr};
    const auto error_of = [&](const std::string& rest) {
        EXPECT_EQ(scan_error(kThree + rest), "no error");
        return scan_error(kThree + rest, with_normals);
    };
    EXPECT_EQ(error_of("vn 0 0 1\nf 1//1 2//1 3//-1\n"), "no error");
    EXPECT_EQ(error_of("vn 0 nan 1\nf 1//1 2//1 3//1\n"),
              "x.obj:4: normal: expected a finite number, got 'nan'");
    EXPECT_EQ(error_of("vn 0 1\nf 1//1 2//1 3//1\n"), "x.obj:4: normal: expected 3 numbers, got 2");
    EXPECT_EQ(error_of("vn 0 0 1\nf 1//1 2//2 3//1\n"),
              "x.obj:5: normal index 2 is out of range: expected 1 to 1");
    EXPECT_EQ(error_of("f 1//1 2//1 3//1\n"),
              "x.obj:4: normal index 1 is out of range: the file has none");
    EXPECT_EQ(error_of("vn 0 0 1\nf 1//1 2 3//1\n"),
              "x.obj: vertex 2 has no normal (vn) in any of its faces");
    // One corner is enough, and a vertex without faces needs none.
    EXPECT_EQ(error_of("v 5 5 5\nvn 0 0 1\nf 1//1 2 3//1\nf 2//1 1//1 3//1\n"), "no error");
}

}  // namespace
}  // namespace paim
