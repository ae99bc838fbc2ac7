// Files that mean harm: a clear error or a mesh, never a crash, a hang or a huge allocation.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <random>

#include "compressor/io/obj_parse.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

using Clock = std::chrono::steady_clock;

// Reads the text as a sequence of one pose and returns the error, or "no error". These files
// have at most 4 MB, the largest of them mostly vertices and faces that take a hundred bytes for
// eight: half a gigabyte is far more than they need, as is the time.
std::string open_and_load(const std::string& text, const ObjOptions& options = {}) {
    const auto start = Clock::now();
    const ObjTestFiles files({text});
    const std::string message =
        files.shortened(bad_input_of([&] { ObjSequence(files.files(), options).load_pose(0); }));
    EXPECT_LT(std::chrono::duration<double>(Clock::now() - start).count(), 20.0);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 500 * 1024);  // kilobytes
    return message;
}

std::string repeat(const std::string& text, size_t count) {
    std::string all;
    for (size_t i = 0; i < count; ++i) all += text;
    return all;
}

const std::string kMesh = kTriangleObj;

TEST(HostileObj, LongLines) {
    const std::string long_word(size_t{4} << 20, '7');
    EXPECT_EQ(open_and_load("#" + long_word + "\n" + kMesh), "no error");
    EXPECT_EQ(open_and_load("g " + long_word + "\n" + kMesh), "no error");
    EXPECT_EQ(open_and_load("usemtl " + long_word + "\n" + kMesh), "no error");
    EXPECT_EQ(open_and_load(kMesh + std::string(size_t{4} << 20, ' ')), "no error");
    EXPECT_EQ(open_and_load("v " + long_word + " 0 0\n" + kMesh),
              "0.obj:1: vertex coordinate: expected a finite number, got '" + std::string(40, '7') +
                  "...'");
    EXPECT_EQ(open_and_load(kMesh + "f " + long_word + " 1 2\n"),
              "0.obj:5: face index " + std::string(40, '7') +
                  "... is out of range: expected at most 2147483647");
    EXPECT_EQ(open_and_load("v 0." + long_word + " 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "no error");
    EXPECT_EQ(open_and_load(kMesh + "f" + repeat(" 1", 1 << 20)),
              "0.obj:5: face: expected at most 1000000 vertices");
}

TEST(HostileObj, ManyShortLines) {
    // Each of these lines makes simple readers allocate far more than its own length.
    EXPECT_EQ(open_and_load(kMesh + repeat("t a 8192/8192/8192\n", 50000)), "no error");
    EXPECT_EQ(open_and_load(kMesh + repeat("g a\nf 1 2 3\no b\n", 50000)), "no error");
    EXPECT_EQ(open_and_load(kMesh + repeat("usemtl a\nf 1 2 3\nusemtl b\n", 20000)), "no error");
    EXPECT_EQ(open_and_load("g " + std::string(100000, 'n') + "\n" + kMesh +
                            repeat("usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n", 20000)),
              "no error");
    EXPECT_EQ(open_and_load(repeat("\n", 4 << 20) + kMesh), "no error");
    EXPECT_EQ(open_and_load(kMesh + repeat("l 1 2\np 1\nvw 0 -1 1\nvp 0\n", 50000)), "no error");
}

TEST(HostileObj, PolygonsThatAreHardToCut) {
    // Zigzags over all vertices that cross themselves at every step.
    std::mt19937 random(1);
    std::string text;
    for (int i = 0; i < 255; ++i) {
        text += fmt::format("v {} {} 0\n", random() % 1000, random() % 1000);
    }
    for (int k = 0; k < 100; ++k) {
        text += "f";
        for (int i = 0; i < 255; ++i) text += fmt::format(" {}", (i * (k + 1)) % 255 + 1);
        text += "\n";
    }
    EXPECT_EQ(open_and_load(text), "no error");
}

TEST(HostileObj, PolygonsOfManyNotches) {
    // Saws of 100,000 teeth: corners times notches are far more steps than there is time for.
    std::string text;
    for (int i = 0; i < 200000; ++i) text += fmt::format("v {} {} 0\n", i, i % 2 == 0 ? 50 : 1);
    text += "v 200000 0 0\nv 0 0 0\nf";
    for (int i = 200002; i > 0; --i) text += fmt::format(" {}", i);
    EXPECT_EQ(open_and_load(text + "\n"), "no error");
}

TEST(HostileObj, MaterialLinesOfManyWords) {
    std::string text = "mtllib";
    for (int i = 0; i < 500000; ++i) text += fmt::format(" {}", i);
    const ObjTestFiles files({text + "\nusemtl" + repeat(" a #", 500000) + "\n" + kMesh});
    const ObjSequence sequence(files.files());
    ASSERT_EQ(sequence.warnings().size(), 10u);
    EXPECT_EQ(sequence.warnings()[0], "mtllib: expected at most 4096 words in all lines together");
}

TEST(HostileObj, NumbersThatParsersStumbleOver) {
    const std::string rest = "v 1 0 0\nv 0 1 0\nf 1/1/1 2/1/1 3/1/1\n";
    // Coordinates and normals that are not used may be anything; exponents may overflow an int.
    EXPECT_EQ(open_and_load("v 0 0 0\nvt 1e2147483649\nvn nan 1e2147483649 -\n" + rest),
              "no error");
    EXPECT_EQ(open_and_load("v 1e-2147483649 0 0\n" + rest), "no error");
    EXPECT_EQ(open_and_load("v 1e2147483649 0 0\n" + rest),
              "0.obj:1: vertex coordinate: expected a number from -3.4e38 to 3.4e38, got "
              "'1e2147483649'");
    ObjOptions options;
    options.normals_from_file = true;
    EXPECT_EQ(open_and_load("v 0 0 0\nvn 3e38 3e38 1e-45\n" + rest, options), "no error");
}

TEST(HostileObj, Garbage) {
    // Random bytes, then random words from the format's own vocabulary: any error but no crash.
    std::mt19937 random(2);
    const std::vector<std::string> words{"v ",     "vn ",     "vt ",     "f ", "\n",   "1 ", "-1 ",
                                         "2/1/1 ", "3//1 ",   "0 ",      "\\", "\r",   "#",  " ",
                                         "1e5 ",   "usemtl ", "mtllib ", "/",  "nan ", "g ", "l ",
                                         "\n",     "\n",      "1 2 3\n"};
    for (int i = 0; i < 300; ++i) {
        std::string bytes(random() % 2000, ' ');
        for (char& c : bytes) c = static_cast<char>(random());
        if (i % 2 == 0) std::replace(bytes.begin(), bytes.end(), '\0', ' ');
        std::string soup = kMesh;
        for (int k = 0; k < 60; ++k) soup += words[random() % words.size()];
        for (const bool normals : {false, true}) {
            std::string copy = bytes;
            EXPECT_NE(scan_error(copy, {normals, nullptr}), "no error");
            std::string text = soup;
            const ObjScan* scan = nullptr;
            ObjScan result;
            const std::string message = bad_input_of([&] {
                result = scan_obj("x", text, {normals, nullptr, true});
                scan = &result;
            });
            // What the scan lets pass, the parser reads the same way.
            if (scan == nullptr) continue;
            EXPECT_EQ(bad_input_of([&] { parse_obj("x", text, *scan); }), "no error") << soup;
            std::string whole = soup;
            EXPECT_EQ(scan_positions("x", whole), scan->positions) << soup;
        }
    }
}

TEST(HostileObj, MaterialLibrariesThatAreNoFiles) {
    const ObjTestFiles files(
        {"mtllib pipe\nmtllib ../../../../../../dev/zero\nmtllib .\n" + kMesh});
    const std::filesystem::path folder = files.files()[0].parent_path();
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const ObjSequence sequence(files.files());
    EXPECT_EQ(files.warnings(sequence), (std::vector<std::string>{
                                            "pipe: expected a regular file",
                                            "../../../../../../dev/zero: expected a regular file",
                                            ".: expected a regular file",
                                        }));
}

TEST(HostileObj, MaterialLibrariesThatGrow) {
    // The same library of 1 MB under ever new names, a material every 9 bytes: 4 fit into 4 MiB,
    // the other 46 are named, 8 of them one by one.
    std::string text;
    for (int i = 0; i < 50; ++i) text += "mtllib " + repeat("./", i) + "x.mtl\n";
    const ObjTestFiles files({text + kMesh});
    files.add("x.mtl", repeat("newmtl a\n", 110000));
    const ObjSequence sequence(files.files());
    ASSERT_EQ(sequence.warnings().size(), 9u);
    EXPECT_EQ(files.warnings(sequence).back(), "0.obj: 38 more warnings about material files");
}

}  // namespace
}  // namespace paim
