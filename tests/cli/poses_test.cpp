// paim-poses as a user runs it: exit codes, messages, files, and the same bytes every time.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "paim/base/file.h"
#include "tests/cli/run_tool.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

ToolResult run_poses(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), PAIM_POSES);
    return run_tool(arguments);
}

void expect_failure(const ToolResult& result, int exit_code, const std::string& message) {
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_NE(result.err.find(message), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
}

TEST(PosesTool, ExplainsItself) {
    const ToolResult help = run_poses({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (const char* word : {"octopus", "sphere", "box", "plates", "cavity", "bowl", "--vertices",
                             "--poses", "--json", "exact for the octopus"}) {
        EXPECT_NE(help.out.find(word), std::string::npos) << word;
    }
    const ToolResult version = run_poses({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_EQ(version.out.rfind("paim-poses ", 0), 0u) << version.out;
}

TEST(PosesTool, RefusesWhatItDoesNotKnow) {
    const TemporaryDirectory directory;
    const std::string out = (directory / "out").string();
    expect_failure(run_poses({}), 1, "NAME is required");
    expect_failure(run_poses({"octopus"}), 1, "--output is required");
    expect_failure(run_poses({"squid", "-o", out}), 1,
                   "NAME: expected one of octopus, sphere, box, plates, cavity, bowl, got 'squid'");
    expect_failure(run_poses({"octopus", "-o", out, "--vertices", "999"}), 1,
                   "--vertices of octopus: expected 1000 to 2000000, got 999");
    expect_failure(run_poses({"box", "-o", out, "--vertices", "-3"}), 1,
                   "--vertices of box: expected 50 to 2000000, got -3");
    expect_failure(run_poses({"box", "-o", out, "--poses", "0"}), 1,
                   "--poses: expected 1 to 10000, got 0");
    expect_failure(run_poses({"box", "-o", out, "--poses", "99999999999"}), 1,
                   "--poses: expected 1 to 10000, got 99999999999");
    expect_failure(run_poses({"box", "-o", out, "--poses", "many"}), 1, "--poses");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(PosesTool, SaysWhereItCannotWrite) {
    const TemporaryDirectory directory;
    write_file(directory / "file", "in the way");
    const std::string in_file = (directory / "file").string();
    expect_failure(run_poses({"box", "-o", in_file}), 4, in_file + ": ");
    const std::string below_file = (directory / "file" / "below").string();
    expect_failure(run_poses({"box", "-o", below_file}), 4, below_file + ": ");
}

TEST(PosesTool, ReportsInJsonWhatItWrote) {
    const TemporaryDirectory directory;
    const std::string out = (directory / "out").string();
    const ToolResult result =
        run_poses({"octopus", "-o", out, "--poses", "3", "--vertices", "1500", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto report = nlohmann::json::parse(result.out);
    EXPECT_EQ(report["name"], "octopus");
    EXPECT_EQ(report["directory"], out);
    EXPECT_EQ(report["num_poses"], 3);
    EXPECT_EQ(report["num_vertices"], 1500);
    EXPECT_EQ(report["num_triangles"], 2996);  // 2V − 4, closed and without handles
    EXPECT_EQ(report["first_file"], "octopus_0000.obj");
    EXPECT_EQ(report["last_file"], "octopus_0002.obj");
    size_t num_files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(out)) {
        EXPECT_EQ(entry.path().extension(), ".obj");
        ++num_files;
    }
    EXPECT_EQ(num_files, 3u);
}

TEST(PosesTool, ReportsNamesThatAreNotUtf8) {
    const TemporaryDirectory directory;
    const ToolResult result = run_poses(
        {"box", "-o", (directory / "\xfd").string(), "--vertices", "50", "--poses", "1", "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(nlohmann::json::accept(result.out)) << result.out;
}

TEST(PosesTool, WritesTheSameBytesEveryTime) {
    const TemporaryDirectory directory;
    for (const std::string name : {"octopus", "sphere", "box", "plates", "cavity", "bowl"}) {
        const auto first = directory / (name + "1"), second = directory / (name + "2");
        const auto make = [&](const std::filesystem::path& out, const char* threads) {
            const ToolResult result = run_poses({name, "-o", out.string(), "--poses", "4",
                                                 "--vertices", "1200", "--threads", threads});
            ASSERT_EQ(result.exit_code, 0) << result.err;
            EXPECT_NE(result.out.find("4 poses in " + out.string()), std::string::npos);
        };
        make(first, "1");
        make(second, "3");
        std::vector<char> previous;
        for (const char* number : {"0000", "0001", "0002", "0003"}) {
            const std::string file = name + "_" + number + ".obj";
            const auto bytes = read_file(first / file, 1 << 20);
            EXPECT_FALSE(bytes.empty());
            EXPECT_EQ(bytes, read_file(second / file, 1 << 20)) << file;
            EXPECT_NE(bytes, previous) << file << " is as the pose before";
            previous = bytes;
        }
    }
}

TEST(PosesTool, LeavesColorsOutWhenAsked) {
    const TemporaryDirectory directory;
    const std::string out = directory.path().string();
    const auto first_vertex = [&] {
        const auto bytes = read_file(directory / "octopus_0000.obj", 1 << 20);
        const std::string text(bytes.begin(), bytes.end());
        const size_t begin = text.find("\nv ") + 1;
        return text.substr(begin, text.find('\n', begin) - begin);
    };
    const auto num_spaces = [](const std::string& line) {
        return std::count(line.begin(), line.end(), ' ');
    };
    ASSERT_EQ(run_poses({"octopus", "-o", out, "--poses", "1", "--vertices", "1000"}).exit_code, 0);
    EXPECT_EQ(num_spaces(first_vertex()), 6);
    ASSERT_EQ(run_poses({"octopus", "-o", out, "--poses", "1", "--vertices", "1000", "--plain"})
                  .exit_code,
              0);
    EXPECT_EQ(num_spaces(first_vertex()), 3);
}

}  // namespace
}  // namespace paim
