// A vertex that is somewhere else in a few poses is named, and changes nothing of the other poses.
#include <fmt/format.h>

#include <cmath>

#include "paim/codec/sequence_bounds.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class OutlierTool : public ToolTest {
  protected:
    // A tube of 11 rings of 8 vertices, 2 units tall, that bends, as OBJ files in this folder.
    // bad  lines of vertices by pose and number
    std::string write_bad_tube(const std::string& folder,
                               const std::map<std::pair<int, int>, std::string>& bad) const {
        std::filesystem::create_directory(directory_ / folder);
        for (int p = 0; p < 10; ++p) {
            std::string text;
            for (int v = 0; v < 88; ++v) {
                const double y = 0.2 * (v / 8), angle = 2.0 * kPi * (v % 8) / 8.0;
                const double bend = 0.1 * y * y * std::sin(2.0 * kPi * p / 10.0);
                const auto found = bad.find({p, v});
                text += found != bad.end()
                            ? found->second
                            : fmt::format("v {:.6f} {:.6f} {:.6f}\n", 0.2 * std::sin(angle) + bend,
                                          y, 0.2 * std::cos(angle));
            }
            for (int v = 0; v < 80; ++v) {
                const int next = v % 8 == 7 ? v - 7 : v + 1;
                text += fmt::format("f {} {} {} {}\n", v + 1, next + 1, next + 9, v + 9);
            }
            write(fmt::format("{}/t_{:04}.obj", folder, p), text);
        }
        return path(folder);
    }

    std::string bake_bad_tube(const std::string& folder,
                              const std::map<std::pair<int, int>, std::string>& bad,
                              const Arguments& options = {}) const {
        const std::string bake = path(folder + ".bake");
        Arguments arguments{
            "bake", write_bad_tube(folder, bad), "-o", bake, "--rays", "64", "--bands", "2"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        expect_success(compress(arguments));
        return bake;
    }
};

TEST_F(OutlierTool, NamesOutliers) {
    const std::string file = path("x.paim");
    const std::string clean = bake_bad_tube("clean", {});
    EXPECT_FALSE(contains(compress({"encode", clean, "-o", file}).err, "beyond"));
    std::map<std::pair<int, int>, std::string> bad{{{4, 33}, "v 5000 4000 0\n"},
                                                   {{4, 34}, "v 50 0 0\n"}};
    const std::string bake = bake_bad_tube("two", bad);
    for (const Arguments& options : {Arguments{"--measure"}, Arguments{"--max-error", "10%"}}) {
        Arguments arguments{"encode", bake, "-o", file};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const ToolResult told = compress(arguments);
        expect_success(told);
        EXPECT_TRUE(contains(told.err, "t_0004.obj (pose 4): vertex 34 and 1 more of 88 vertices "))
            << told.err;
        EXPECT_TRUE(contains(told.err, "at (5000, 4000, 0), 6402 from where")) << told.err;
        arguments.push_back("--json");
        const auto report = parse_object(compress(arguments));
        ASSERT_EQ(report["outliers"].size(), 1u);
        EXPECT_EQ(report["outliers"][0]["name"], "t_0004.obj");
        EXPECT_EQ(report["outliers"][0]["num_vertices"], 2);
        EXPECT_EQ(report["outliers"][0]["vertex"], 33);
        EXPECT_NEAR(report["outliers"][0]["distance"].get<double>(), 6402.0, 1.0);
        EXPECT_LT(report["measured"]["position_outlier_worst"].get<double>(), 0.05);
        EXPECT_LT(report["measured"]["position_relative_rms"].get<double>(), 0.0021);
        EXPECT_LT(report["measured"]["sted"].get<double>(), 0.03);
        const ToolResult verified = analyze({bake, "--verify", file});
        EXPECT_EQ(verified.exit_code, 0) << verified.out;
        EXPECT_TRUE(contains(verified.out, "position_outlier_worst")) << verified.out;
        EXPECT_LT(sequence_bounds(read_paim(file)).diagonal(), 2.5f);
    }
    // Four notes at most.
    for (int p = 0; p < 10; ++p) bad[{p, p}] = "v 0 0 -900\n";
    const ToolResult told = compress({"encode", bake_bad_tube("every", bad), "-o", file});
    EXPECT_TRUE(contains(told.err, "note: outliers in 6 more poses")) << told.err;
}

TEST_F(OutlierTool, MakesTheSameBytesOnAnyNumberOfThreads) {
    const std::string bake =
        bake_bad_tube("x", {{{0, 3}, "v 1e30 0 0\n"}, {{7, 80}, "v 0 -77 0\n"}});
    for (const Arguments& options : {Arguments{}, Arguments{"--max-error", "10%"}}) {
        std::vector<std::vector<char>> files;
        for (const char* const threads : {"1", "3"}) {
            Arguments arguments{"encode", bake, "-o", path("x.paim"), "--threads", threads};
            arguments.insert(arguments.end(), options.begin(), options.end());
            expect_success(compress(arguments));
            files.push_back(read_file(path("x.paim"), uint64_t{1} << 30));
        }
        EXPECT_TRUE(files[0] == files[1]);
    }
}

// The floor lies where it lies without them, and the camera shows the same.
TEST_F(OutlierTool, LeavesTheFloorAlone) {
    const Arguments floor{"--floor", "--floor-vertices", "100"};
    const std::string clean = bake_bad_tube("clean", {}, floor);
    const std::string bad = bake_bad_tube("bad", {{{4, 33}, "v 5000 -4000 0\n"}}, floor);
    EXPECT_EQ(BakeReader(bad).identity().floor, BakeReader(clean).identity().floor);
    expect_success(compress({"encode", bad, "-o", path("x.paim")}));
    EXPECT_LT(sequence_bounds(read_paim(path("x.paim"))).diagonal(), 10.0f);
    // The whole body is elsewhere in one pose.
    std::map<std::pair<int, int>, std::string> jump;
    for (int v = 0; v < 88; ++v) jump[{4, v}] = fmt::format("v {} -1000 {}\n", v % 8, v / 8);
    const std::string jumped = bake_bad_tube("jumped", jump, floor);
    EXPECT_EQ(BakeReader(jumped).identity().floor, BakeReader(clean).identity().floor);
}

}  // namespace
}  // namespace paim
