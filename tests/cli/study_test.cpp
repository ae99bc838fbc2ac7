// paim-study: command lines that make no sense, and what cannot be measured of one pose.
#include <sstream>
#include <utility>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Study : public ToolTest {
  protected:
    static ToolResult study(const std::string& name, Arguments options) {
        options.insert(options.begin(), {name, "bowl"});
        return run(PAIM_STUDY, options);
    }
};

TEST_F(Study, RefusesWhatMakesNoSense) {
    const std::vector<std::pair<Arguments, Arguments>> cases{
        {{"--rays", "63"}, {"--rays: expected an even number", "got 63"}},
        {{"--rays", "64,0"}, {"--rays: expected 2 to 16777216, got '0'"}},
        {{"--truth-rays", "101"}, {"--truth-rays: expected an even number", "got 101"}},
        {{"--truth-rays", "0"}, {"--truth-rays: expected 2 to 16777216, got '0'"}},
        {{"--bands", "65"}, {"--bands: expected 1 to 64, got '65'"}},
        {{"--bands", "0"}, {"--bands: expected 1 to 64, got '0'"}},
        {{"--poses", "0"}, {"--poses: expected 1 to 10000, got '0'"}},
        {{"--targets", "0.1,0"}, {"--targets: expected ", "got '0'"}},
        {{"--targets", "nan"}, {"--targets: expected ", "got 'nan'"}},
        {{"--vertices", "1"}, {"expected", "vertices, got 1"}},
        {{"--colour"}, {"unknown option '--colour'"}},
    };
    for (const auto& [options, parts] : cases) expect_failure(study("noise", options), 1, parts);
    expect_failure(study("nose", {}), 1, {"STUDY", "nose"});
}

TEST_F(Study, LeavesTheFlickerOfOnePoseEmpty) {
    const Arguments few{"--vertices", "60", "--bands", "2", "--truth-rays", "64", "--rays", "16"};
    for (const uint32_t num_poses : {1u, 3u}) {
        Arguments options = few;
        options.insert(options.end(), {"--poses", std::to_string(num_poses)});
        const ToolResult result = study("noise", options);
        expect_success(result);
        EXPECT_FALSE(contains(result.out, "nan")) << result.out;
        std::istringstream text(result.out);
        std::string line;
        std::getline(text, line);
        EXPECT_TRUE(line.ends_with(",flicker")) << line;
        size_t num_rows = 0;
        for (; std::getline(text, line); ++num_rows) {
            if (contains(line, "estimates itself")) continue;  // never has one
            EXPECT_EQ(line.ends_with(','), num_poses == 1) << line;
        }
        EXPECT_GT(num_rows, 3u);
    }
}

}  // namespace
}  // namespace paim
