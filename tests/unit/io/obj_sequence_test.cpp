// Sequences: what is read, what all files must share, errors and warnings in their words.
#include "compressor/io/obj_sequence.h"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "paim/base/hash.h"
#include "paim/base/tbb_parallel.h"
#include "paim/mesh/normals.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

TEST(ObjSequence, ReadsPositionsAndComputesNormals) {
    // Two objects, a relative index, a quad, a decimal that float rounds.
    const ObjTestFiles files({
        "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\no b\nv 0 0 1.1\nf 1/1 -1/1 2/1\n",
        "v 0 0 0\r\nv 2 0 0\r\nv 2 2 0\r\nv 0 2 0\r\nv 0 0 2.2\r\ng x\r\nf 1 2 3 4\r\nf 1 5 2\r\n",
    });
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.num_poses(), 2u);
    EXPECT_EQ(files.shortened(sequence.pose_name(1)), "1.obj");
    EXPECT_EQ(sequence.topology(), (Topology{5, {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}}}));
    EXPECT_TRUE(sequence.warnings().empty());
    EXPECT_EQ(sequence.albedo().values, Albedo().values);

    const Pose pose = sequence.load_pose(1);
    EXPECT_EQ(pose.positions,
              (std::vector<Vec3f>{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2.2f}}));
    EXPECT_EQ(pose.normals, vertex_normals(sequence.topology(), pose.positions));
    const auto bytes = read_file(files.files()[1], 1000);
    EXPECT_EQ(sequence.pose_checksum(1), xxh3(bytes.data(), bytes.size()));
    EXPECT_NE(sequence.pose_checksum(0), sequence.pose_checksum(1));
}

TEST(ObjSequence, RoundsCoordinatesToTheNearestFloat) {
    // 1.0000000597 is just above 1 + 2^-24, half-way between floats: digits added up in float,
    // or cut off, miss it.
    const ObjTestFiles files(
        {"v 1.0000000597 0.1 123456.789\nv 16777217.5 -1e-7 3e38\n"
         "v 0.13642546 8.00000095 -0.3333333333333333333333333333\nf 1 2 3\n"});
    const Pose pose = ObjSequence(files.files()).load_pose(0);
    EXPECT_EQ(pose.positions, (std::vector<Vec3f>{{1.00000012f, 0.1f, 123456.789f},
                                                  {16777218.0f, -1e-7f, 3e38f},
                                                  {0.13642546f, 8.00000095f, -0.33333334f}}));
}

TEST(ObjSequence, TriangulatesAllPosesLikeTheFirst) {
    // The second pose alone would be cut along the other diagonal.
    const std::string faces = "f 1 2 3 4\n";
    const ObjTestFiles files({"v 0 0 0\nv 3 0 0\nv 4 1 0\nv 1 1 0\n" + faces,
                              "v 1 0 0\nv 4 0 0\nv 3 1 0\nv 0 1 0\n" + faces});
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.topology().triangles, (std::vector<Triangle>{{0, 1, 3}, {1, 2, 3}}));
    const ObjSequence turned({files.files()[1], files.files()[0]});
    EXPECT_EQ(turned.topology().triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

// Two squares that meet at a right angle along the y axis, with vertices of their own there, and
// one more pose in which the second square has moved by this.
std::vector<std::string> seam_poses(double moved_by) {
    const auto pose = [](double x) {
        return fmt::format(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
            "v {0} 0 0\nv {0} 1 0\nv {0} 1 1\nv {0} 0 1\n"
            "vn 0 0 1\nvn 1 0 0\nf 1//1 2//1 3//1 4//1\nf 5//2 6//2 7//2 8//2\n",
            x);
    };
    return {pose(0.0), pose(0.0), pose(moved_by), pose(0.0)};
}

TEST(ObjSequence, SharesNormalsAcrossSeamsOfAllPoses) {
    const Vec3f both = Vec3f(1, 0, 1).normalized();
    const ObjTestFiles together(seam_poses(0.0)), apart(seam_poses(1e-6));
    const ObjSequence closed(together.files()), opens(apart.files());
    for (const uint32_t p : {0u, 2u}) {
        const Pose pose = closed.load_pose(p);
        for (const size_t v : {0, 3, 4, 5}) {
            EXPECT_LT((pose.normals[v] - both).norm(), 1e-6f) << p << ' ' << v;
        }
        EXPECT_LT((pose.normals[1] - Vec3f(0, 0, 1)).norm(), 1e-6f);
        // One pose in which they part is enough, in the poses before it, too.
        EXPECT_LT((opens.load_pose(p).normals[0] - Vec3f(0, 0, 1)).norm(), 1e-6f) << p;
        EXPECT_LT((opens.load_pose(p).normals[4] - Vec3f(1, 0, 0)).norm(), 1e-6f) << p;
    }
    ObjOptions options;
    options.normals_from_file = true;
    EXPECT_EQ(ObjSequence(together.files(), options).load_pose(0).normals[0], Vec3f(0, 0, 1));
}

// A sphere of rings, closed by two points. Its first meridian is there twice if `has_seam`.
// bad     line of vertex 20, or nothing
// inward  whether it is mirrored, so that its faces face inwards
std::string sphere_text(bool has_seam, const std::string& bad = "", bool inward = false) {
    constexpr size_t kRings = 7, kSegments = 8;
    const size_t num_columns = has_seam ? kSegments + 1 : kSegments;
    std::string text = "v 0 -1 0\nv 0 1 0\n";
    size_t number = 2;
    for (size_t ring = 1; ring <= kRings; ++ring) {
        for (size_t column = 0; column < num_columns; ++column) {
            const double down = kPi * static_cast<double>(ring) / (kRings + 1);
            const double round =
                (inward ? -2.0 : 2.0) * kPi * static_cast<double>(column % kSegments) / kSegments;
            const bool is_bad = ++number == 20 && !bad.empty();
            text += is_bad
                        ? bad
                        : fmt::format("v {:.6f} {:.6f} {:.6f}\n", std::sin(down) * std::sin(round),
                                      -std::cos(down), std::sin(down) * std::cos(round));
        }
    }
    const auto at = [&](size_t ring, size_t column) {
        return 3 + (ring - 1) * num_columns + column % num_columns;
    };
    for (size_t column = 0; column < kSegments; ++column) {
        text += fmt::format("f 1 {} {}\n", at(1, column + 1), at(1, column));
        text += fmt::format("f 2 {} {}\n", at(kRings, column), at(kRings, column + 1));
        for (size_t ring = 1; ring < kRings; ++ring) {
            text += fmt::format("f {} {} {} {}\n", at(ring, column), at(ring, column + 1),
                                at(ring + 1, column + 1), at(ring + 1, column));
        }
    }
    return text;
}

// Vertex 20 lies on the seam and is far away in one pose; the other poses have the normals that
// they have without it.
TEST(ObjSequence, SharesNormalsAcrossASeamWithAnOutlier) {
    const std::string good = sphere_text(true), bad = sphere_text(true, "v 5000 4000 0\n");
    const ObjTestFiles clean({good, good, good, good}), broken({good, good, bad, good});
    const auto expected = ObjSequence(clean.files()).load_pose(0).normals;
    const auto got = ObjSequence(broken.files()).load_pose(0).normals;
    for (size_t v = 0; v < expected.size(); ++v) {
        // Coordinates have six digits, so that quads are flat to 1e-5 of their sides.
        EXPECT_LT((got[v] - expected[v]).norm(), 1e-4f) << v;
    }
}

TEST(ObjSequence, TurnsNoPartsForAnOutlierInTheFirstPose) {
    const std::string good = sphere_text(false), bad = sphere_text(false, "v 0 5000 0\n");
    const ObjTestFiles files({bad, good, good, good});
    ObjOptions options;
    options.orient = true;
    const ObjSequence sequence(files.files(), options);
    EXPECT_EQ(sequence.num_inward(), 0u);
    EXPECT_LT((sequence.load_pose(1).normals[0] - Vec3f(0, -1, 0)).norm(), 1e-3f);
}

TEST(ObjSequence, FindsPartsThatFaceInwardsInSpiteOfAnOutlier) {
    for (const bool has_seam : {false, true}) {  // vertex 20 is on the seam
        const std::string good = sphere_text(has_seam, "", true);
        const std::string bad = sphere_text(has_seam, "v 0 5000 0\n", true);
        for (size_t p = 0; p < 4; ++p) {
            std::vector<std::string> texts(4, good);
            texts[p] = bad;
            EXPECT_EQ(ObjSequence(ObjTestFiles(texts).files()).num_inward(), 1u) << p;
        }
    }
}

// The normals at the rims of a prism, lower and upper, whose caps are these faces (of vertices
// counted from 1, those of the upper cap; the lower one is the same from below).
std::vector<Vec3f> prism_normals(const std::vector<Vec3d>& rim,
                                 const std::vector<std::vector<size_t>>& caps) {
    const size_t n = rim.size();
    std::string text;
    for (const int z : {0, 2}) {
        for (const Vec3d& x : rim) text += fmt::format("v {:.9f} {:.9f} {}\n", x.x(), x.y(), z);
    }
    text += "v 0 0 0\nv 0 0 2\n";  // the middles, number n + 1 of each cap
    for (size_t i = 1; i <= n; ++i) {
        const size_t j = i % n + 1;
        text += fmt::format("f {} {} {} {}\n", i, j, n + j, n + i);
    }
    for (const std::vector<size_t>& cap : caps) {
        std::string upper = "f", lower;
        for (const size_t i : cap) {
            upper += fmt::format(" {}", i <= n ? n + i : 2 * n + 2);
            lower = fmt::format(" {}", i <= n ? i : 2 * n + 1) + lower;
        }
        text += upper + "\nf" + lower + "\n";
    }
    const ObjTestFiles files({text});
    std::vector<Vec3f> normals = ObjSequence(files.files()).load_pose(0).normals;
    normals.resize(2 * n);
    return normals;
}

TEST(ObjSequence, NormalsDoNotDependOnHowCapsAreCut) {
    for (const size_t n : {5, 12, 31}) {
        std::vector<Vec3d> rim;
        std::vector<std::vector<size_t>> fans(n);
        std::vector<size_t> whole;
        for (size_t i = 0; i < n; ++i) {
            const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(n);
            rim.emplace_back(std::cos(angle), std::sin(angle), 0.0);
            fans[i] = {n + 1, i + 1, (i + 1) % n + 1};
            whole.push_back(i + 1);
        }
        const auto expected = prism_normals(rim, fans);
        const auto got = prism_normals(rim, {whole});
        // Sums of the same angles, cut otherwise, differ by their rounding.
        for (size_t v = 0; v < 2 * n; ++v) EXPECT_LT((got[v] - expected[v]).norm(), 3e-7f) << n;
    }
    // An angle: two sides of a right angle each, and a cap of a right angle, or three at the notch.
    const std::vector<Vec3d> angle{{1, -1, 0},   {1, -0.5, 0}, {-0.5, -0.5, 0},
                                   {-0.5, 1, 0}, {-1, 1, 0},   {-1, -1, 0}};
    const auto got = prism_normals(angle, {{1, 2, 3, 4, 5, 6}});
    const std::vector<Vec3f> expected{{1, -1, 1}, {1, 1, 1},  {1, 1, 3},
                                      {1, 1, 1},  {-1, 1, 1}, {-1, -1, 1}};
    for (size_t v = 0; v < 6; ++v) {
        const Vec3f lower = expected[v].cwiseProduct(Vec3f(1, 1, -1)).normalized();
        EXPECT_LT((got[v] - lower).norm(), 1e-6f) << v;
        EXPECT_LT((got[6 + v] - expected[v].normalized()).norm(), 1e-6f) << v;
    }
}

TEST(ObjSequence, NamesPartsThatFaceInwards) {
    const std::string good = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    const std::string bad = "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    const auto warnings = [](const std::string& text, bool orient = false) {
        const ObjTestFiles files({text});
        ObjOptions options;
        options.orient = orient;
        const ObjSequence sequence(files.files(), options);
        std::string all;
        for (const std::string& line : sequence.warnings()) all += files.shortened(line);
        return all;
    };
    EXPECT_EQ(warnings("o x\n" + corners + good), "");
    EXPECT_EQ(warnings(corners + bad),
              "0.obj: the part with vertex 1 is closed (4 triangles) and faces inwards: --orient "
              "turns it, so that its outside is lit");
    EXPECT_EQ(warnings("g a\no body\ng skin\n" + corners + bad, true),
              "0.obj: the part with vertex 1 in 'body' is closed (4 triangles) and faces inwards: "
              "turned");
    EXPECT_EQ(warnings("g hand left\n" + corners + bad + "g other\nv 9 9 9\nf 1 2 5\n", true), "");
    const ObjTestFiles files({corners + bad});
    ObjOptions options;
    options.orient = true;
    const ObjSequence turned(files.files(), options);
    EXPECT_EQ(turned.num_inward(), 1u);
    EXPECT_LT((turned.load_pose(0).normals[0] - Vec3f(-1, -1, -1).normalized()).norm(), 1e-6f);
}

TEST(ObjSequence, AveragesNormalsOfTheFile) {
    ObjOptions options;
    options.normals_from_file = true;
    // Vertex 1: mean of +z and +y, not unit in the file. Vertex 2: one corner has none. Vertex 3:
    // its vn is zero, vertex 4: its two cancel; both get the computed one. Vertex 5 has no face.
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\n";
    const ObjTestFiles files(
        {mesh + "vn 0 0 5\nvn 0 1e-20 0\nvn 0 0 0\nvn 0 -3 0\n"
                "f 1//1 2//2 3//3\nf 1//2 3//3 4//4\nf 1//1 2 4//2\n",
         // Other normals in another order.
         "vn 1 0 0\n" + mesh + "f 1//1 2//1 3//1\nf 1//-1 3//1 4//1\nf 1//1 2//1 4//1\n"});
    const ObjSequence sequence(files.files(), options);
    Pose pose = sequence.load_pose(0);
    // Float rounding of a unit vector's entries.
    EXPECT_LT((pose.normals[0] - Vec3f(0, 1, 2).normalized()).norm(), 1e-7f);
    EXPECT_EQ(pose.normals[1], Vec3f(0, 1, 0));
    EXPECT_EQ(pose.normals[2], Vec3f(0, 0, 1));
    EXPECT_EQ(pose.normals[3], Vec3f(0, 0, 1));
    EXPECT_EQ(pose.normals[4], Vec3f(0, 0, 0));
    pose = sequence.load_pose(1);
    for (int v = 0; v < 4; ++v) EXPECT_EQ(pose.normals[v], Vec3f(1, 0, 0));

    EXPECT_EQ(sequence_error({kTriangleObj}, options),
              "0.obj: vertex 1 has no normal (vn) in any of its faces");
}

TEST(ObjSequence, RefusesFilesUnlikeTheFirst) {
    const std::string good = kTriangleObj;
    EXPECT_EQ(sequence_error({good, good + "v 0 0 0\n"}),
              "1.obj: 4 vertices, expected 3 (as in 0.obj)");
    EXPECT_EQ(sequence_error({good, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n"}),
              "1.obj:4: face 1 is '1 3 2', expected '1 2 3' (as in 0.obj)");
    EXPECT_EQ(sequence_error({good, good + "f 3 2 1\n"}),
              "1.obj: 2 faces, expected 1 (as in 0.obj)");
    EXPECT_EQ(sequence_error({good, "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"}),
              "1.obj:2: vertex coordinate: expected a finite number, got 'nan'");
    EXPECT_EQ(sequence_error({good, ""}), "1.obj: no vertices");
    EXPECT_EQ(sequence_error({"", good}), "0.obj: no vertices");
    EXPECT_EQ(sequence_error({"v 0 0 0\nf 1 1 1\n"}),
              "0.obj: no faces with three different vertices");
    EXPECT_EQ(bad_input_of([] { ObjSequence({}); }), "no OBJ files: expected at least one");
    EXPECT_EQ(bad_input_of([] { ObjSequence({"/nonexistent/x.obj"}); }),
              "/nonexistent/x.obj: cannot open: No such file or directory");
}

TEST(ObjSequence, NamesTheReferenceWithItsFolderOnlyIfItIsAnother) {
    const ObjTestFiles first({kTriangleObj}), second({std::string(kTriangleObj) + "v 0 0 0\n"});
    const std::string first_name = first.files()[0].string();
    const std::string message = bad_input_of([&] {
        ObjSequence({first.files()[0], second.files()[0]});
    });
    EXPECT_EQ(second.shortened(message),
              "0.obj: 4 vertices, expected 3 (as in " + first_name + ")");
}

TEST(ObjSequence, ReportsTheFirstBadFileOnAnyNumberOfThreads) {
    std::vector<std::string> contents(40, kTriangleObj);
    for (const size_t i : {17, 18, 25, 39}) contents[i] = "bad";
    contents[11] = "bad";
    // Good files take their time, so that bad ones behind are found before bad ones in front.
    ObjOptions slow;
    slow.on_file_checked = [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); };
    for (const int num_threads : {1, 2, 8}) {
        const ThreadLimit limit(num_threads);
        EXPECT_EQ(sequence_error(contents, slow), "11.obj: no vertices") << num_threads;
    }
}

TEST(ObjSequence, CallsBackForEachFile) {
    const ObjTestFiles files(std::vector<std::string>(7, kTriangleObj));
    std::atomic<int> count{0};
    ObjOptions options;
    options.on_file_checked = [&] { ++count; };
    const ObjSequence sequence(files.files(), options);
    EXPECT_EQ(count.load(), 7);
}

TEST(ObjSequence, NoticesFilesThatChange) {
    const ObjTestFiles files({kTriangleObj, kTriangleObj});
    const ObjSequence sequence(files.files());
    files.add("1.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
    EXPECT_EQ(files.shortened(bad_input_of([&] { sequence.load_pose(1); })),
              "1.obj: changed since the sequence was opened");
    EXPECT_EQ(sequence.load_pose(0).positions.size(), 3u);
}

TEST(ObjSequence, CountsWhatIsOdd) {
    const ObjTestFiles files(
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 2 0 0\nv 3 0 0\nv 4 0 0\n"
         "f 1 2 3\nf 1 2\nl 1 2\np 4\nf 1 1 2 3\nf 2 5 6 7\n"});
    EXPECT_EQ(files.warnings(ObjSequence(files.files())),
              (std::vector<std::string>{
                  "0.obj: 1 faces of fewer than 3 vertices ignored",
                  "0.obj: 2 points and lines ignored",
                  "0.obj: 1 faces name a vertex twice",
                  "0.obj: 1 faces without area or tangled, cut as fans",
              }));
}

}  // namespace
}  // namespace paim
