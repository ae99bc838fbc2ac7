// paim-analyze --curves-of, --curves-groups and --curves-rays: curves over components of a vertex, groups of
// vertices, and rays.
#include <string>
#include <vector>

#include "tests/cli/csv_and_json.h"

namespace paim {
namespace {

using nlohmann::json;

class SettingCurves : public ToolTest {
  protected:
    SettingCurves() {
        const std::string folder = make_poses("octopus", 5, 1000);
        expect_success(
            compress({"bake", folder, "-o", path("x.bake"), "--bands", "4", "--rays", "256"}));
        for (const std::string codec : {"cpca", "svd"}) {
            expect_success(compress({"encode", path("x.bake"), "-o", path(codec + ".paim"),
                                     "--max-error", "5%", "--codec", codec}));
        }
    }

    // Small and quick.
    ToolResult measure(const std::string& output, const Arguments& more) const {
        Arguments arguments{path("x.bake"), "-o", path(output), "--size", "48",
                            "--poses",      "2",  "--views",    "2"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return analyze(arguments);
    }

    // The table and the JSON of a curve have the same numbers by the same names.
    void expect_same_numbers(const std::string& folder, const std::string& curve,
                             const json& settings) const {
        const std::vector<Arguments> table = read_csv(folder + "/" + curve + ".csv");
        ASSERT_EQ(table.size(), 1 + settings.size());
        expect_numbers_are_in(table, settings);
        for (size_t row = 1; row < table.size(); ++row) {
            const json& setting = settings[row - 1];
            // All but light and all; numbers that are not known are null.
            EXPECT_GE(expect_same_names(table[0], table[row], setting), 10);
            EXPECT_EQ(std::stoul(table[row][1]), setting[curve].get<size_t>());
        }
    }
};

TEST_F(SettingCurves, AFileLosesComponentsOfItsVertices) {
    const json report = parse_object(
        measure("out", {"--curves-of", path("cpca.paim"), "--components", "4,2,1,0", "--json"}));
    EXPECT_FALSE(report.contains("bands"));  // curves of the bake were not asked for
    const json& settings = report["cluster_components"];
    ASSERT_EQ(settings.size(), 5u);
    EXPECT_EQ(settings[0]["all"], true);
    EXPECT_EQ(settings[4]["cluster_components"], 0);
    EXPECT_EQ(settings[0]["theory_error"], 0.0);
    EXPECT_EQ(settings[4]["theory_error"], 1.0);
    EXPECT_EQ(settings[4]["energy_error"], 1.0);
    for (size_t n = 1; n < settings.size(); ++n) {
        for (const char* const error : {"theory_error", "energy_error", "transfer_error"}) {
            EXPECT_GT(settings[n][error], settings[n - 1][error]) << n << ' ' << error;
        }
        EXPECT_GT(settings[n]["lights"]["sky"]["visual_error"],
                  settings[n - 1]["lights"]["sky"]["visual_error"]);
        EXPECT_LT(settings[n]["multiply_adds"], settings[n - 1]["multiply_adds"]);
        EXPECT_LT(settings[n]["vertex_values"], settings[n - 1]["vertex_values"]);
    }
    // 3 (J + 1) under coloured light.
    EXPECT_EQ(settings[4]["multiply_adds"], 3);
    expect_same_numbers("out", "cluster_components", settings);
    expect_page_names_all("out");
}

TEST_F(SettingCurves, MoreGroupsErrLess) {
    const ToolResult result = measure("out", {"--curves-groups", "4,1,16,4,30000", "--json"});
    // A thousand vertices, and at least eight a group; each once.
    EXPECT_TRUE(contains(result.err, "note: 30000 clusters asked for, there are vertices for 1"))
        << result.err;
    const json report = parse_object(result);
    const json& settings = report["clusters"];
    ASSERT_EQ(settings.size(), 4u);
    EXPECT_EQ(settings[3]["clusters"], 1);
    EXPECT_EQ(settings[1]["clusters"], 16);
    for (size_t n = 1; n < settings.size(); ++n) {
        EXPECT_GT(settings[n]["transfer_error"], settings[n - 1]["transfer_error"]) << n;
        EXPECT_GT(settings[n]["lights"]["sky"]["visual_error"],
                  settings[n - 1]["lights"]["sky"]["visual_error"]);
        EXPECT_LT(settings[n]["size"], settings[n - 1]["size"]);
        EXPECT_LT(settings[n]["cpu_multiply_adds"], settings[n - 1]["cpu_multiply_adds"]);
        // What a vertex takes does not depend on the groups.
        EXPECT_EQ(settings[n]["multiply_adds"], settings[0]["multiply_adds"]);
        EXPECT_EQ(settings[n]["vertex_components"], settings[0]["vertex_components"]);
    }
    expect_same_numbers("out", "clusters", settings);
    expect_page_names_all("out");
}

TEST_F(SettingCurves, FewerRaysAreNoisier) {
    const ToolResult result = measure("out", {"--curves-rays", "16,64,1024", "--json"});
    EXPECT_TRUE(contains(result.err, "note: rays: 1024 asked for, there are 256\n")) << result.err;
    const json report = parse_object(result);
    const json& settings = report["rays"];
    ASSERT_EQ(settings.size(), 3u);
    EXPECT_EQ(settings[0]["rays"], 256);
    EXPECT_EQ(settings[0]["all"], true);
    EXPECT_EQ(settings[2]["rays"], 16);
    for (const json& setting : settings) {
        const double error = setting["transfer_error"];
        // What a bake states of itself is right, and so is the law from 256 rays. Observed: 0.93 to 1.00 and
        // 0.97 to 1.01.
        EXPECT_NEAR(setting["stated_noise"].get<double>() / error, 1.0, 0.15) << setting["rays"];
        EXPECT_NEAR(setting["expected_noise"].get<double>() / error, 1.0, 0.15) << setting["rays"];
    }
    EXPECT_EQ(settings[0]["expected_noise"], settings[0]["stated_noise"]);
    for (size_t n = 1; n < settings.size(); ++n) {
        EXPECT_GT(settings[n]["lights"]["sky"]["visual_error"],
                  settings[n - 1]["lights"]["sky"]["visual_error"]);
    }
    // 16 times the rays: an eighth of the noise.
    const double noise = settings[0]["lights"]["sky"]["reference_noise"];
    const double seen = settings[0]["lights"]["sky"]["visual_error"];
    EXPECT_GT(noise, 0.03 * seen);
    EXPECT_LT(noise, 0.3 * seen);
    expect_same_numbers("out", "rays", settings);
    expect_page_names_all("out");
}

// Everything but times, on any number of threads.
TEST_F(SettingCurves, GiveTheSameNumbersAgain) {
    const auto tables = [&](const std::string& output, const std::string& threads) {
        expect_success(measure(output, {"--curves-of", path("cpca.paim"), "--curves-groups", "4,9",
                                        "--curves-rays", "32", "--threads", threads}));
        std::vector<std::vector<Arguments>> all;
        for (const std::string curve : {"cluster_components", "clusters", "rays"}) {
            std::vector<Arguments> table = read_csv(output + "/" + curve + ".csv");
            for (size_t n = table[0].size(); n-- > 0;) {
                const std::string& name = table[0][n];
                const bool is_time = contains(name, "[s]") || contains(name, "[ms") ||
                                     contains(name, "[s per pose]");
                if (!is_time) continue;
                for (Arguments& row : table) row.erase(row.begin() + static_cast<long>(n));
            }
            all.push_back(table);
        }
        return all;
    };
    const auto one = tables("one", "1");
    EXPECT_EQ(one, tables("two", "2"));
    EXPECT_GE(one[0][0].size(), 15u);
}

TEST_F(SettingCurves, SayWhatIsWrong) {
    const auto expect_wrong = [&](const Arguments& arguments, int exit_code,
                                  const std::string& part) {
        expect_failure(measure("out", arguments), exit_code, {part});
        EXPECT_FALSE(std::filesystem::exists(path("out/index.html")));
    };
    expect_wrong({"--curves-of", path("svd.paim")}, 2,
                 "svd.paim: its transfer has no components of vertices (codec svd)");
    expect_wrong({"--curves-of", path("none.paim")}, 2, "none.paim");
    expect_wrong({"--curves-of", ""}, 1, "--curves-of: expected a value, got none");
    expect_wrong({"--curves-groups", "0"}, 1, "--curves-groups: expected numbers from 1 to");
    expect_wrong({"--curves-groups", "8,"}, 1, "--curves-groups: expected numbers");
    expect_wrong({"--curves-groups", ""}, 1, "--curves-groups: expected numbers");
    expect_wrong({"--curves-rays", "16,3"}, 1, "--curves-rays: expected even numbers");
    expect_wrong({"--curves-rays", "0"}, 1, "--curves-rays: expected even numbers");
    expect_wrong({"--curves-rays", "many"}, 1, "--curves-rays: expected even numbers");
    expect_failure(analyze({path("x.bake"), "--verify", path("svd.paim"), "--curves-rays", "16"}),
                   1, {"--verify excludes --curves-rays"});
    // More than there are.
    const ToolResult more =
        measure("out", {"--curves-of", path("cpca.paim"), "--components", "999,1"});
    EXPECT_EQ(more.exit_code, 0);
    EXPECT_TRUE(contains(more.err, "note: cluster_components: 999 asked for, there are "))
        << more.err;
}

}  // namespace
}  // namespace paim
