// Meshes far from the world's origin: digits that float would lose, on any number of threads.
#include <fmt/format.h>

#include "paim/base/tbb_parallel.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

TEST(ObjOrigin, ScanReadsPositionsToTheNearestDouble) {
    std::string text =
        "v +1 -2.5 3e0\nv 1e-999 0 \\\n -7\nv 4.25 .1 -5. 9 9 9\n"
        "v 80000.300000000003 0.30000000000000004 123456789.12345678\nf 1 2 3\n";
    const ObjScan scan = scan_obj("x.obj", text, {false, nullptr, true});
    EXPECT_EQ(
        scan.positions,
        (std::vector<Vec3d>{
            {1, -2.5, 3}, {0, 0, -7}, {4.25, 0.1, -5}, {80000.3, 0.1 + 0.2, 123456789.12345678}}));
    EXPECT_TRUE(scan_text(kTriangleObj).positions.empty());
}

TEST(ObjOrigin, KeepsTheDigitsOfMeshesFarAway) {
    // 0.1 is lost in float at 1e6: steps are 0.0625 there. Bounds of both poses: 1000000 … 1000004
    // and 0 … 2, diagonal 4.5, so the origin is the centre rounded to a multiple of 4.
    const std::string faces = "f 1 2 3\n";
    const ObjTestFiles files({"v 1000000.1 0 0\nv 1000001.1 0 0\nv 1000000.1 2 0\n" + faces,
                              "v 1000000 0 0\nv 1000004 0 0\nv 1000003.3 2 0\n" + faces});
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.origin(), Vec3d(1000004, 0, 0));
    // Doubles near a million are 1.2e-10 apart.
    const Pose pose = sequence.load_pose(0);
    EXPECT_NEAR(pose.positions[0].x(), -3.9, 1e-6);
    EXPECT_NEAR(pose.positions[1].x(), -2.9, 1e-6);
    EXPECT_NEAR(sequence.load_pose(1).positions[2].x(), -0.7, 1e-6);
    EXPECT_EQ(pose.normals[0], Vec3f(0, 0, 1));
    // Alone, the second pose has another origin; a vertex without a face does not count.
    EXPECT_EQ(ObjSequence({files.files()[1]}).origin(), Vec3d(1000004, 0, 0));
    const ObjTestFiles stray(
        {"v 1000000.1 0 0\nv 1000001.1 0 0\nv 1000000.1 2 0\nv 0 0 0\n" + faces});
    EXPECT_EQ(ObjSequence(stray.files()).origin(), Vec3d(1000000, 2, 0));
}

// A body of size 2 that travels 200,000: floats near 200,000 are 0.016 apart.
TEST(ObjOrigin, GivesPosesOfATravellerOriginsOfTheirOwn) {
    const auto at = [](int x) {
        return fmt::format("v {0}.1 0 0\nv {1}.1 0 0\nv {0}.1 2 0\nf 1 2 3\n", x, x + 1);
    };
    const ObjTestFiles files({at(0), at(100000), at(200000)});
    const ObjSequence sequence(files.files());
    EXPECT_EQ(sequence.origin(), Vec3d::Zero());
    EXPECT_EQ(sequence.pose_offset(0), Vec3d::Zero());
    EXPECT_EQ(sequence.pose_offset(1), Vec3d(100000, 2, 0));  // multiples of 2
    EXPECT_NEAR(sequence.load_pose(2).positions[0].x(), 0.1, 1e-6);
    EXPECT_NEAR(load_from_origin(sequence, 2).positions[0].x(), 200000.1, 0.008);
    // Still meshes are counted from a given origin.
    ObjOptions options;
    options.origin = Vec3d::Zero();
    EXPECT_EQ(ObjSequence(files.files(), options).pose_offset(2), Vec3d::Zero());
}

// One vertex of a sheet at x = 1e6 is elsewhere in one pose.
TEST(ObjOrigin, IsNotMovedByAnOutlier) {
    const auto sheet = [](const std::string& last) {
        std::string text;
        for (int j = 0; j < 49; ++j) text += fmt::format("v {} {} 0\n", 1000000 + j % 7, j / 7);
        text += last;
        for (int j = 1; j + 8 <= 50; ++j) text += fmt::format("f {} {} {}\n", j, j + 1, j + 7);
        text += "f 48 49 50\n";
        return text;
    };
    const ObjTestFiles good({sheet("v 1000006 7 0\n"), sheet("v 1000006 7 0\n")});
    const ObjTestFiles bad({sheet("v 1000006 7 0\n"), sheet("v 1e30 0 0\n")});
    EXPECT_EQ(ObjSequence(bad.files()).origin(), ObjSequence(good.files()).origin());
    EXPECT_EQ(ObjSequence(bad.files()).pose_offset(1), Vec3d::Zero());
}

TEST(ObjOrigin, IsZeroWhereFloatsAreEnough) {
    const ObjTestFiles files({"v 10 0 0\nv 11 0 0\nv 10 1 0\nf 1 2 3\n"});
    EXPECT_EQ(ObjSequence(files.files()).origin(), Vec3d::Zero());
}

TEST(ObjOrigin, RefusesWhatNoFloatHoldsFromThere) {
    // Floats end at 3.4e38.
    const std::string near = "v -3e38 0 0\nv -3.01e38 0 0\nv -3e38 1e36 0\n", face = "f 1 2 3\n";
    const auto expect_refused = [](const std::string& error, const std::string& file) {
        EXPECT_TRUE(error.starts_with(file + ": coordinates are too large when counted from the "
                                             "origin (-3"))
            << error;
    };
    EXPECT_EQ(sequence_error({near + face, near + face}), "no error");
    // A vertex without a face counts for nothing.
    EXPECT_EQ(sequence_error({near + "v 3e38 0 0\n" + face}), "no error");
    // A still mesh is counted from the origin of the poses.
    ObjOptions options;
    options.origin = Vec3d(-3e38, 0, 0);
    expect_refused(sequence_error({"v 3e38 0 0\nv 3.01e38 0 0\nv 3e38 1e36 0\n" + face}, options),
                   "0.obj");
}

TEST(ObjOrigin, RefusesMeshesBelowNormalFloats) {
    // Normal floats begin at 1.18e-38. All poses count, and a point has no size to be refused.
    const std::string face = "f 1 2 3\n";
    const std::string small = "v 0 0 0\nv 1e-39 0 0\nv 0 1e-39 0\n" + face;
    const std::string large = "v 0 0 0\nv 2e-38 0 0\nv 0 1e-39 0\n" + face;
    const std::string error = sequence_error({small, small});
    EXPECT_TRUE(error.starts_with("0.obj: the mesh is 1.41e-39 across, expected at least 1.18e-38"))
        << error;
    EXPECT_EQ(sequence_error({small, large}), "no error");
    EXPECT_EQ(sequence_error({"v 5 0 0\nv 5 0 0\nv 5 0 0\n" + face}), "no error");
}

TEST(ObjOrigin, DoesNotDependOnThreads) {
    std::vector<std::string> contents;
    for (int i = 0; i < 30; ++i) {
        contents.push_back(
            fmt::format("v {}.3 0 0\nv 5001.7 0 0\nv 5002 1 0\nf 1 2 3\n", 5000 + i * i % 17));
    }
    const ObjTestFiles files(contents);
    const auto origin = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        return ObjSequence(files.files()).origin();
    };
    EXPECT_EQ(origin(1), Vec3d(5008, 0, 0));
    for (const int num_threads : {2, 8}) EXPECT_EQ(origin(num_threads), origin(1));
}

TEST(ObjOrigin, TriangulatesByTheNearDigits) {
    // A kite whose shorter diagonal is 1 3: in float at 4e7 (steps of 4) no shape would be left.
    const auto kite = [](double x) {
        std::string text;
        for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, -2, 0), Vec3d(2, 0, 0), Vec3d(1, 2, 0)}) {
            text += fmt::format("v {} {} 0\n", p.x() + x, p.y());
        }
        return text + "f 1 2 3 4\n";
    };
    const ObjTestFiles files({kite(0), kite(4e7)});
    EXPECT_EQ(ObjSequence({files.files()[0]}).topology(),
              ObjSequence({files.files()[1]}).topology());
    const ObjSequence far({files.files()[1]});
    EXPECT_EQ(far.load_pose(0).normals[0], Vec3f(0, 0, 1));
    EXPECT_TRUE(far.warnings().empty());
}

}  // namespace
}  // namespace paim
