// paim-play --progressive as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <future>
#include <nlohmann/json.hpp>
#include <thread>

#include "paim/base/file.h"
#include "paim/image/exr.h"
#include "player/prefix_loader.h"
#include "tests/cli/run_tool.h"
#include "tests/directory_watch.h"
#include "tests/first_components.h"
#include "tests/player/prefix_file.h"
#include "tests/player/test_asset.h"
#include "tests/player/window_keys.h"
#include "tests/player/x_server.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

// Nothing takes so long but what never comes.
constexpr std::chrono::minutes kHung{5};

class PrefixPlayTest : public testing::Test {
  protected:
    PrefixPlayTest() {
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
    }

    static ToolResult snapshot(const std::filesystem::path& file, const std::string& picture,
                               std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{PAIM_PLAY, file.string(), "--snapshot", picture,
                                           "--size",  "90x60",       "--pose",     "2.5",
                                           "--bands", "4",           "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_tool(arguments);
    }

    std::string out(const char* name) const { return (directory_ / name).string(); }

    TemporaryDirectory directory_;
    std::filesystem::path path_ = directory_ / "ball.paim";
    Asset asset_ = make_test_asset({});  // 5 bands, 3 + 5 components, 6 poses
    PrefixFile file_{path_, asset_};
};

TEST_F(PrefixPlayTest, SnapshotOfAPrefixIsThatOfAFileWithItsComponents) {
    size_t num_limited = 0;
    for (const Prefix& prefix : file_.prefixes) {
        file_.write_up_to(prefix.size_bytes);
        const ToolResult result = snapshot(path_, out("a.exr"), {"--progressive"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err, "");
        const auto json = nlohmann::json::parse(result.out);
        EXPECT_EQ(json["complete"], prefix == file_.prefixes.back());
        EXPECT_EQ(json["bytes"], prefix.size_bytes);
        EXPECT_EQ(json["whole_bytes"], file_.bytes.size());
        EXPECT_EQ(json["components"], prefix.geometry_components + prefix.transfer_components);
        EXPECT_EQ(json["whole_components"], 8);
        EXPECT_EQ(json["transfer_components"], prefix.transfer_components);
        const Image image = read_exr(out("a.exr"));

        write_paim(out("cut.paim"), first_components(asset_, prefix.geometry_components,
                                                     prefix.transfer_components));
        const ToolResult cut = snapshot(out("cut.paim"), out("b.exr"));
        ASSERT_EQ(cut.exit_code, 0) << cut.err;
        EXPECT_FALSE(nlohmann::json::parse(cut.out).contains("complete"));
        EXPECT_EQ(image.pixels, read_exr(out("b.exr")).pixels);

        // Of the whole file, which has another camera unless all geometry is in use.
        if (prefix.geometry_components < asset_.moving().positions.num_components) continue;
        ++num_limited;
        const ToolResult whole =
            snapshot(path_.string() + ".whole", out("c.exr"),
                     {"--transfer-components", std::to_string(prefix.transfer_components)});
        ASSERT_EQ(whole.exit_code, 0) << whole.err;
        EXPECT_EQ(image.pixels, read_exr(out("c.exr")).pixels);
    }
    EXPECT_GE(num_limited, 1u);
}

TEST_F(PrefixPlayTest, TakesAPrefixOnlyWhenAsked) {
    file_.write_up_to(file_.prefixes[3].size_bytes);
    const ToolResult refused = snapshot(path_, out("a.png"));
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("the file is cut short"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(out("a.png")));

    // More components may come, so that nothing is said of those that are not there.
    const ToolResult limited = snapshot(
        path_, out("a.png"), {"--progressive", "--transfer-components", "5", "--exposure", "-3"});
    EXPECT_EQ(limited.exit_code, 0);
    EXPECT_EQ(limited.err, "");

    const ToolResult bench = run_tool(
        {PAIM_PLAY, path_.string(), "--progressive", "--bench", "2", "--size", "40x30", "--json"});
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    EXPECT_EQ(nlohmann::json::parse(bench.out)["components"], 3);

    std::filesystem::resize_file(path_, file_.prefixes[0].size_bytes - 1);
    const ToolResult nothing = snapshot(path_, out("b.png"), {"--progressive"});
    EXPECT_EQ(nothing.exit_code, 2);
    EXPECT_NE(nothing.err.find("that can be played"), std::string::npos) << nothing.err;
}

// The window is opened on a file that is not there yet. When the whole file is, the window shows
// its picture, at the pose where it was stopped.
TEST_F(PrefixPlayTest, WindowSharpensToTheWholeFilesPicture) {
    const XServer server(PAIM_XVFB);
    ToolResult result;
    std::promise<void> waits;
    std::jthread player([&] {
        bool noted = false;
        const auto listen = [&](const ToolResult& so_far) {
            if (noted || so_far.err.find('\n') == std::string::npos) return;
            noted = true;
            waits.set_value();
        };
        result = run_tool({"/bin/sh", "-c",
                           "cd '" + directory_.path().string() + "' && exec " + PAIM_PLAY +
                               " ball.paim --progressive --size 120x80 --bands 4 --turn-light 0"},
                          listen);
    });
    file_.write_up_to(file_.prefixes[0].size_bytes - 1);
    ASSERT_EQ(waits.get_future().wait_for(kHung), std::future_status::ready);
    file_.write_up_to(file_.prefixes[0].size_bytes);
    WindowKeys keys("ball.paim - paim-play");
    keys.press("Home");  // pose 0, paused
    int num_pictures = 0;
    const auto save_view = [&] {
        const std::string name = fmt::format("ball-{:03}.png", ++num_pictures);
        DirectoryWatch pictures(directory_.path());
        keys.press("s");
        EXPECT_TRUE(pictures.wait_for(name));
        return read_file(directory_ / name, 1 << 20);
    };
    const auto expected = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{PAIM_PLAY, path_.string(), "--snapshot", out("e.png"),
                                           "--size",  "120x80",       "--bands",    "4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ToolResult snapshot = run_tool(arguments);
        EXPECT_EQ(snapshot.exit_code, 0) << snapshot.err;
        return read_file(out("e.png"), 1 << 20);
    };
    EXPECT_EQ(save_view(), expected({"--progressive"}));

    // The camera stays where the first asset put it until the animation is framed again (F).
    for (size_t i = 1; i < file_.prefixes.size(); ++i)
        file_.write_up_to(file_.prefixes[i].size_bytes);
    const std::vector<char> whole = expected({});
    const auto hung = std::chrono::steady_clock::now() + kHung;
    bool reached = false;
    while (!reached && std::chrono::steady_clock::now() < hung) {
        keys.press("f");
        reached = save_view() == whole;
    }
    EXPECT_TRUE(reached);
    keys.press("Escape");
    player.join();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err,
              "paim-play: note: ball.paim: waiting for the first part that can be played\n");
}

// A window shows the first part of a large file before it has read the rest. Damage of the rest closes
// it.
TEST_F(PrefixPlayTest, WindowOfALargeFileClosesOnDamage) {
    const XServer server(PAIM_XVFB);
    TestAssetOptions options;
    options.bands = 8;
    options.num_rings = 70;
    options.num_poses = 12;
    options.transfer_components = 10;
    write_paim(path_, make_test_asset(options));
    ASSERT_GT(std::filesystem::file_size(path_), LoaderPace::kFirstBytes);
    const auto play = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{PAIM_PLAY, path_.string(), "--size", "60x40"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_tool(arguments);
    };
    const ToolResult good = play({"--frames", "3"});
    EXPECT_EQ(good.exit_code, 0) << good.err;
    EXPECT_EQ(good.err, "");

    std::vector<char> bytes = read_file(path_, uint64_t{1} << 30);
    bytes.back() ^= 1;
    write_file(path_, std::string_view(bytes.data(), bytes.size()));
    const ToolResult damaged = play({});
    EXPECT_EQ(damaged.exit_code, 2);
    EXPECT_NE(damaged.err.find("damaged: the checksum does not match"), std::string::npos)
        << damaged.err;

    std::filesystem::resize_file(path_, LoaderPace::kFirstBytes + 1);
    const ToolResult cut = play({});
    EXPECT_EQ(cut.exit_code, 2);
    EXPECT_NE(cut.err.find("the file is cut short"), std::string::npos) << cut.err;
}

}  // namespace
}  // namespace paim::player
