// In one go, --max-error decides how many rays the bake has.
#include <fmt/format.h>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

using nlohmann::json;

class ChosenRays : public ToolTest {
  protected:
    // In one go, into x.bake and x.paim.
    ToolResult in_one_go(Arguments options) const {
        options.insert(options.begin(), {poses_, "-o", path("x.paim"), "--bands", "3", "--json"});
        return compress(options);
    }
    json rays_of_bake() const { return parse_object(info({path("x.bake"), "--json"}))["rays"]; }
    // Directories of pilots that are left.
    int num_pilots() const {
        int count = 0;
        for (const auto& entry : std::filesystem::directory_iterator(path(""))) {
            if (entry.path().filename().string().starts_with(".x.pilot-")) ++count;
        }
        return count;
    }
    void remove_bake() const { std::filesystem::remove_all(path("x.bake")); }

    std::string poses_ = make_poses("octopus", 6, 1000);
};

TEST_F(ChosenRays, AreAsManyAsTheErrorNeeds) {
    const ToolResult result = in_one_go({"--max-error", "3%"});
    const json report = parse_object(result);
    const uint32_t rays = report["bake"]["rays"];
    const uint32_t pilot = report["pilot"]["rays"];
    EXPECT_GT(report["pilot"]["best_transfer_error"], 0.03);
    EXPECT_GT(rays, pilot);
    EXPECT_LT(rays, 512u);
    EXPECT_LE(report["encode"]["measured"]["transfer_total_error"].get<double>(), 0.03);
    // Few more than are needed: their noise takes most of the error.
    EXPECT_GT(report["encode"]["best_transfer_error"].get<double>(), 0.7 * 0.03);
    for (const std::string& part :
         {fmt::format("about {} rays a vertex should do for an error of 3 %", rays),
          fmt::format("{} leave", pilot)}) {
        EXPECT_TRUE(contains(result.err, part)) << part << " in " << result.err;
    }
    EXPECT_EQ(num_pilots(), 0);
    EXPECT_EQ(analyze({path("x.bake"), "--verify", path("x.paim")}).exit_code, 0);
    // The bake is that of these rays.
    expect_success(compress(
        {"bake", poses_, "-o", path("y.bake"), "--bands", "3", "--rays", std::to_string(rays)}));
    expect_same(contents_of(path("x.bake")), contents_of(path("y.bake")));
}

TEST_F(ChosenRays, AreThoseOfThePilotIfTheyDo) {
    const ToolResult result = in_one_go({"--max-error", "20%"});
    const json report = parse_object(result);
    EXPECT_EQ(report["bake"]["rays"], report["pilot"]["rays"]);
    EXPECT_EQ(report["bake"]["poses_resumed"], 6);
    EXPECT_TRUE(contains(result.err, "rays a vertex do for")) << result.err;
    EXPECT_EQ(num_pilots(), 0);
}

TEST_F(ChosenRays, GrowWhereTheFirstChoiceWasTooFew) {
    // The noise of the worst vertex is one draw, and that of the pilot happens to be small.
    const ToolResult result = in_one_go({"--max-error", "10%", "--max-vertex-error", "5%"});
    const json report = parse_object(result);
    EXPECT_TRUE(contains(result.err, "at the worst vertex, where 5 % is asked for")) << result.err;
    EXPECT_TRUE(contains(result.err, "it is baked again with")) << result.err;
    EXPECT_LE(report["encode"]["measured"]["transfer_worst_vertex_deviation"].get<double>(), 0.05);
    EXPECT_EQ(report["bake"]["poses_baked"], 6);
    EXPECT_EQ(rays_of_bake(), report["bake"]["rays"]);
}

TEST_F(ChosenRays, AreThoseOfABakeThatIsThere) {
    expect_success(
        compress({"bake", poses_, "-o", path("x.bake"), "--bands", "3", "--rays", "48"}));
    const ToolResult result = in_one_go({"--max-error", "10%"});
    const json report = parse_object(result);
    EXPECT_EQ(report["bake"]["rays"], 48);
    EXPECT_EQ(report["bake"]["poses_resumed"], 6);
    EXPECT_FALSE(report.contains("pilot"));
    EXPECT_TRUE(contains(result.err, "is there and keeps its 48 rays")) << result.err;
    // It is not thrown away for one that is good enough.
    expect_failure(in_one_go({"--max-error", "1%"}), 5,
                   {"the bake's noise leaves", "--rays", "this bake was there: remove it"});
    EXPECT_EQ(rays_of_bake(), 48);
}

TEST_F(ChosenRays, AreNotChosenWhereTheyOrTheirNoiseAreGiven) {
    for (const Arguments& options :
         {Arguments{"--max-error", "10%", "--rays", "64"}, Arguments{"--max-size", "1M"},
          Arguments{"--max-error", "10%", "--noise-target", "5%"}, Arguments{}}) {
        const json report = parse_object(in_one_go(options));
        EXPECT_FALSE(report.contains("pilot")) << report;
        remove_bake();
    }
    // Nor made more.
    expect_failure(in_one_go({"--max-error", "1%", "--rays", "64"}), 5,
                   {"--rays", "instead of 64"});
    EXPECT_EQ(rays_of_bake(), 64);
}

TEST_F(ChosenRays, AreNoneWhereNoRaysWouldDo) {
    expect_failure(in_one_go({"--max-error", "1%", "--light-spectrum", "natural"}), 5,
                   {"x.bake: a transfer error", "its 3 bands leave out", "more --bands"});
    EXPECT_FALSE(std::filesystem::exists(path("x.bake")));
    EXPECT_EQ(num_pilots(), 0);
}

TEST_F(ChosenRays, LeaveFoldersAloneThatAreNoBakes) {
    std::filesystem::create_directory(path("x.bake"));
    write("x.bake/notes.txt", "mine");
    expect_failure(in_one_go({"--max-error", "10%"}), 2, {"is not empty and not a bake"});
    EXPECT_EQ(num_pilots(), 0);
    EXPECT_TRUE(std::filesystem::exists(path("x.bake/notes.txt")));
}

TEST_F(ChosenRays, RemoveNothingThatIsNotTheirs) {
    // What was a pilot's name before, and may be anybody's.
    std::filesystem::create_directory(path("x.pilot.bake"));
    write("x.pilot.bake/notes.txt", "mine");
    expect_success(in_one_go({"--max-error", "20%"}));
    EXPECT_TRUE(std::filesystem::exists(path("x.pilot.bake/notes.txt")));
    // Of the bake, only its own files.
    write("x.bake/notes.txt", "mine");
    expect_success(in_one_go({"--max-error", "20%", "--discard-bake"}));
    EXPECT_TRUE(std::filesystem::exists(path("x.bake/notes.txt")));
    EXPECT_FALSE(std::filesystem::exists(path("x.bake/manifest.json")));
    EXPECT_FALSE(std::filesystem::exists(path("x.bake/pose_000000.bin")));
}

TEST_F(ChosenRays, RemovePilotsOfKilledRuns) {
    std::filesystem::create_directory(path(".x.pilot-1"));
    write(".x.pilot-1/manifest.json", "cut");
    write(".x.pilot-1/pose_000000.bin", "cut");
    expect_success(in_one_go({"--max-error", "20%"}));
    EXPECT_EQ(num_pilots(), 0);
}

TEST_F(ChosenRays, AreChosenWhereABakeHasNoPoseYet) {
    expect_success(
        compress({"bake", poses_, "-o", path("x.bake"), "--bands", "3", "--rays", "4096"}));
    for (int p = 0; p < 6; ++p) {
        std::filesystem::remove(path(fmt::format("x.bake/pose_{:06}.bin", p)));
    }
    const json report = parse_object(in_one_go({"--max-error", "10%"}));
    EXPECT_TRUE(report.contains("pilot"));
    EXPECT_LT(report["bake"]["rays"], 4096);
}

}  // namespace
}  // namespace paim
