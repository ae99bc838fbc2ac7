// paim-play --bench --json: times that are there, positive and consistent. No test asserts how fast.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paim/format/paim/paim_write.h"
#include "tests/cli/run_tool.h"
#include "tests/player/test_asset.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

class BenchTest : public testing::Test {
  protected:
    nlohmann::json bench(const TestAssetOptions& asset, std::vector<std::string> arguments) {
        const std::string file = (directory_ / "ball.paim").string();
        write_paim(file, make_test_asset(asset));
        arguments.insert(arguments.begin(),
                         {PAIM_PLAY, file, "--bench", "9", "--size", "64x48", "--json"});
        const ToolResult result = run_tool(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return nlohmann::json::parse(result.out);
    }

    TemporaryDirectory directory_;
};

TEST_F(BenchTest, SaysWhatFramesCost) {
    TestAssetOptions clustered;
    clustered.num_clusters = 4;
    clustered.cluster_components = 2;
    for (const TestAssetOptions& asset : {TestAssetOptions(), clustered}) {
        for (const std::string decoder : {"gpu", "cpu"}) {
            const nlohmann::json json = bench(asset, {"--decoder", decoder});
            EXPECT_EQ(json["frames"], 9);
            for (const std::string name :
                 {"frame", "still_frame", "vertices", "still_vertices", "cpu"}) {
                ASSERT_TRUE(json.contains(name + "_median_ms")) << name;
                const double least = json[name + "_min_ms"], median = json[name + "_median_ms"],
                             p99 = json[name + "_p99_ms"];
                EXPECT_GT(least, 0.0) << name;
                EXPECT_LE(least, median) << name;
                EXPECT_LE(median, p99) << name;
            }
            const auto ratio = [&](const std::string& a, const std::string& b) {
                return json[a + "_median_ms"].get<double>() / json[b + "_median_ms"].get<double>();
            };
            EXPECT_DOUBLE_EQ(json["frame_to_still_ratio"], ratio("frame", "still_frame"));
            EXPECT_DOUBLE_EQ(json["vertices_to_still_ratio"], ratio("vertices", "still_vertices"));
            EXPECT_DOUBLE_EQ(json["vertices_to_cpu_ratio"], ratio("vertices", "cpu"));
            EXPECT_GT(json["first_picture_ms"], 0.0);
            EXPECT_GT(json["whole_picture_ms"], 0.0);
            EXPECT_GT(json["first_picture_bytes"], 0);
            EXPECT_LE(json["first_picture_bytes"], json["file_bytes"]);
            EXPECT_GE(json["cpu_threads"], 1);
            EXPECT_EQ(json["texture_bytes"] == 0, decoder == "cpu");
            EXPECT_GT(json["buffer_bytes"], 0);
        }
    }
}

}  // namespace
}  // namespace paim::player
