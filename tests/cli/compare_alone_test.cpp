// paim-analyze --compare without a bake: files are compared with the first of them.
#include <algorithm>
#include <string>
#include <vector>

#include "tests/cli/csv_and_json.h"

namespace paim {
namespace {

using nlohmann::json;

class CompareAlone : public ToolTest {
  protected:
    CompareAlone() {
        const std::string folder = make_poses("octopus", 4, 1000);
        expect_success(
            compress({"bake", folder, "-o", path("x.bake"), "--bands", "3", "--rays", "64"}));
        expect_success(compress({"encode", path("x.bake"), "-o", path("exact.paim"),
                                 "--geometry-components", "all", "--transfer-components", "all"}));
        for (const std::string error : {"10%", "20%"}) {
            expect_success(compress(
                {"encode", path("x.bake"), "-o", path(error + ".paim"), "--max-error", error}));
        }
    }

    ToolResult compare(const Arguments& files, const Arguments& more = {}) const {
        Arguments arguments{"--compare"};
        for (const std::string& file : files) arguments.push_back(path(file));
        for (const std::string word :
             {"-o", "out", "--size", "48", "--poses", "2", "--views", "2"}) {
            arguments.push_back(word == "out" ? path(word) : word);
        }
        arguments.insert(arguments.end(), more.begin(), more.end());
        return analyze(arguments);
    }
};

TEST_F(CompareAlone, SaysHowUnlikeFilesAreToTheFirst) {
    const json report =
        parse_object(compare({"exact.paim", "10%.paim", "20%.paim", "exact.paim"}, {"--json"}));
    const json& files = report["compare"];
    ASSERT_EQ(files.size(), 4u);
    const auto difference = [&](size_t file) {
        return files[file]["lights"]["sky"]["difference"].get<double>();
    };
    EXPECT_EQ(difference(0), 0.0);
    EXPECT_GT(difference(1), 0.0);
    EXPECT_GT(difference(2), difference(1));
    EXPECT_EQ(difference(3), 0.0);  // the same file again
    EXPECT_EQ(files[1]["size"], std::filesystem::file_size(path("10%.paim")));
    EXPECT_TRUE(files[0]["stated_transfer_total_error"].is_null());  // it was not measured
    EXPECT_LE(files[1]["stated_transfer_total_error"], 0.1);
    const std::vector<Arguments> table = read_csv("out/compare.csv");
    expect_numbers_are_in(table, files);
    for (size_t file = 0; file < files.size(); ++file) {
        EXPECT_GE(expect_same_names(table[0], table[1 + file], files[file]), 13);
    }
    expect_page_names_all("out");
    EXPECT_TRUE(contains(text_of("out/index.html"), "No truth is known"));
}

// With all components, what is played is the bake: the first file is then the truth, and differences are
// the visual errors that are measured with it, under the same cameras.
TEST_F(CompareAlone, OfTheBakeItselfDifferencesAreVisualErrors) {
    const json alone = parse_object(compare({"exact.paim", "20%.paim"}, {"--json"}))["compare"];
    const json with_bake = parse_object(
        analyze({path("x.bake"), "--compare", path("20%.paim"), "-o", path("b"), "--size", "48",
                 "--poses", "2", "--views", "2", "--json"}))["compare"];
    const double seen = with_bake[0]["lights"]["sky"]["visual_error"];
    // Rounding of floats may move an outline by a pixel.
    EXPECT_NEAR(alone[1]["lights"]["sky"]["difference"].get<double>() / seen, 1.0, 0.02);
}

TEST_F(CompareAlone, SaysThatNoTruthIsKnown) {
    const ToolResult result = compare({"10%.paim", "20%.paim"});
    expect_success(result);
    EXPECT_TRUE(contains(result.out, "20%.paim: ")) << result.out;
    EXPECT_TRUE(contains(result.out, " unlike the first file under sky\n")) << result.out;
    EXPECT_TRUE(contains(result.out, "no truth is known without the bake: ")) << result.out;
}

TEST_F(CompareAlone, RefusesWhatNeedsABake) {
    expect_failure(compare({"10%.paim"}), 1,
                   {"BAKE is required, or two files of --compare or more"});
    for (const Arguments& more :
         {Arguments{"--curves"}, Arguments{"--reference", "traced"}, Arguments{"--sweep"},
          Arguments{"--curves-groups", "4"}, Arguments{"--budget", path("10%.paim")}}) {
        expect_failure(compare({"10%.paim", "20%.paim"}, more), 1, {more[0] + ": needs BAKE"});
    }
    expect_failure(compare({"10%.paim", "none.paim"}), 2, {"none.paim"});
    const std::string other = make_poses("box", 3, 400);
    expect_success(compress({"bake", other, "-o", path("y.bake"), "--bands", "3", "--rays", "16"}));
    expect_success(compress({"encode", path("y.bake"), "-o", path("three.paim")}));
    std::filesystem::remove_all(path("out"));
    expect_failure(compare({"10%.paim", "three.paim"}), 2,
                   {"three.paim: expected the 4 poses of ", "got 3"});
    expect_failure(analyze({"--compare", path("10%.paim"), path("20%.paim"), "-o", path("x.bake")}),
                   1, {"x.bake: is a bake, expected another directory"});
}

}  // namespace
}  // namespace paim
