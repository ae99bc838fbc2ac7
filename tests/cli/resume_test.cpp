// Bakes that are shared, interrupted and gone on with: the same bytes, whoever baked what when.
#include <chrono>
#include <map>
#include <thread>

#include "paim/base/seed.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Resume : public ToolTest {
  protected:
    static Arguments bake_command(const std::string& poses, const std::string& output,
                                  const Arguments& options) {
        Arguments command{"bake", poses, "-o", output};
        command.insert(command.end(), options.begin(), options.end());
        return command;
    }

    static Arguments with_tool(Arguments arguments) {
        arguments.insert(arguments.begin(), PAIM_COMPRESS);
        return arguments;
    }
};

const Arguments kQuick{"--rays", "16", "--bands", "3"};

Arguments quick(const Arguments& more) {
    Arguments options = kQuick;
    options.insert(options.end(), more.begin(), more.end());
    return options;
}

TEST_F(Resume, SameBytesOnAnyNumberOfThreads) {
    const std::string poses = make_poses("octopus", 3, 1000);
    expect_success(compress(bake_command(poses, path("1.bake"), quick({"--threads", "1"}))));
    expect_success(compress(bake_command(poses, path("2.bake"), quick({"--threads", "2"}))));
    expect_same(contents_of(path("1.bake")), contents_of(path("2.bake")));

    for (const std::string threads : {"1", "2"}) {
        std::filesystem::create_directory(directory_ / threads);
        expect_success(compress(
            {"encode", path("1.bake"), "-o", path(threads + "/x.paim"), "--threads", threads}));
    }
    expect_same(contents_of(path("1")), contents_of(path("2")));
}

TEST_F(Resume, KilledBakeGoesOnToTheSameBytes) {
    const std::string poses = make_poses("octopus", 4, 1000);
    const Arguments slow{"--rays", "2048", "--bands", "3"};
    const Arguments command = bake_command(poses, path("killed.bake"), slow);
    BackgroundTool tool(with_tool(command));
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!std::filesystem::exists(path("killed.bake/pose_000000.bin"))) {
        ASSERT_LT(std::chrono::steady_clock::now(), deadline);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    tool.kill();
    ASSERT_EQ(tool.wait(), -SIGKILL);
    ASSERT_FALSE(std::filesystem::exists(path("killed.bake/pose_000003.bin")));

    const ToolResult resumed = compress(command);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_FALSE(contains(resumed.out, " 0 found")) << resumed.out;
    expect_success(compress(bake_command(poses, path("whole.bake"), slow)));
    expect_same(contents_of(path("killed.bake")), contents_of(path("whole.bake")));
}

// Finished poses are never lost nor baked again: their files stay those they were.
TEST_F(Resume, KilledTwentyTimesItLosesNothingButThePoseInFlight) {
    namespace fs = std::filesystem;
    const std::string poses = make_poses("octopus", 30, 1000);
    const Arguments slow{"--rays", "1024", "--bands", "3"};
    const Arguments command = bake_command(poses, path("killed.bake"), slow);
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    expect_success(compress(bake_command(poses, path("whole.bake"), slow)));
    const std::chrono::duration<double> pose_s = (Clock::now() - start) / 30;
    const auto poses_found = [&] {
        std::map<std::string, fs::file_time_type> found;
        if (!fs::exists(path("killed.bake"))) return found;
        for (const auto& entry : fs::directory_iterator(path("killed.bake"))) {
            const std::string name = entry.path().filename().string();
            const bool is_pose = name.starts_with("pose_") && name.ends_with(".bin");
            if (is_pose) found[name] = entry.last_write_time();
        }
        return found;
    };
    std::map<std::string, fs::file_time_type> finished;
    RandomStream random(20);
    int num_killed = 0;
    for (int round = 0; round < 20; ++round) {
        BackgroundTool tool(with_tool(command));
        // In every other round a pose more is finished first; then anywhere within a pose. How fast
        // the machine is, or how busy, does not matter.
        const size_t wanted = finished.size() + static_cast<size_t>(round % 2);
        const auto deadline = Clock::now() + std::chrono::seconds(60);
        while (poses_found().size() < wanted && Clock::now() < deadline) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        std::this_thread::sleep_for(random.uniform() * pose_s);
        tool.kill();
        if (tool.wait() == -SIGKILL) ++num_killed;
        const auto found = poses_found();
        for (const auto& [name, time] : finished) {
            ASSERT_TRUE(found.count(name)) << name;
            EXPECT_EQ(found.at(name), time) << name << " was baked again in round " << round;
        }
        finished = found;
    }
    // Ten poses are waited for, and about one more may come of each pair of rounds.
    EXPECT_GE(num_killed, 15);
    EXPECT_FALSE(finished.empty());
    const ToolResult resumed = compress(command);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_TRUE(contains(resumed.out, std::to_string(finished.size()) + " found")) << resumed.out;
    expect_same(contents_of(path("killed.bake")), contents_of(path("whole.bake")));
}

TEST_F(Resume, KilledBeforeTheManifestGoesOnToo) {
    const std::string poses = make_poses("plates", 2, 60);
    expect_success(compress(bake_command(poses, path("a.bake"), kQuick)));
    std::filesystem::create_directory(directory_ / "b.bake");
    std::filesystem::copy(path("a.bake/mesh.bin"), path("b.bake/mesh.bin"));
    write("b.bake/manifest.json.123-4.tmp", "{");
    write("b.bake/pose_000000.bin.123-5.tmp", "half a pose");
    expect_success(compress(bake_command(poses, path("b.bake"), kQuick)));
    expect_same(contents_of(path("a.bake")), contents_of(path("b.bake")));
}

TEST_F(Resume, SharesMakeTheSameBake) {
    const std::string poses = make_poses("octopus", 4, 1000);
    expect_success(compress(bake_command(poses, path("whole.bake"), kQuick)));
    expect_success(compress(bake_command(poses, path("shared.bake"), quick({"--poses", "2-3"}))));
    const Contents half = contents_of(path("shared.bake"));
    EXPECT_EQ(names_of(half),
              (Arguments{"manifest.json", "mesh.bin", "pose_000002.bin", "pose_000003.bin"}));
    expect_success(compress(bake_command(poses, path("shared.bake"), quick({"--poses", "0-1"}))));
    expect_same(contents_of(path("shared.bake")), contents_of(path("whole.bake")));
}

TEST_F(Resume, ProcessesBakeSharesAtOnce) {
    const std::string poses = make_poses("octopus", 4, 1000);
    expect_success(compress(bake_command(poses, path("whole.bake"), kQuick)));
    for (int round = 0; round < 5; ++round) {
        const std::string shared = path("shared" + std::to_string(round) + ".bake");
        BackgroundTool first(with_tool(bake_command(poses, shared, quick({"--poses", "0-1"}))));
        BackgroundTool second(with_tool(bake_command(poses, shared, quick({"--poses", "2-3"}))));
        EXPECT_EQ(first.wait(), 0);
        EXPECT_EQ(second.wait(), 0);
        expect_same(contents_of(shared), contents_of(path("whole.bake")));
    }
}

TEST_F(Resume, DamagedPosesAreBakedAgain) {
    const std::string bake = make_bake("x.bake");
    const Contents whole = contents_of(bake);
    std::string damaged(whole.at("pose_000001.bin").begin(), whole.at("pose_000001.bin").end());
    damaged[damaged.size() / 2] ^= 1;
    write("x.bake/pose_000001.bin", damaged);
    const ToolResult again = compress(bake_command(path("plates"), bake, kQuick));
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(contains(again.out, "(1 baked, 3 found)")) << again.out;
    expect_same(contents_of(bake), whole);
}

TEST_F(Resume, OtherOptionsAreRefusedByName) {
    const std::string bake = make_bake("x.bake");  // 16 rays, 3 bands
    const Contents before = contents_of(bake);
    const std::string poses = path("plates");
    const auto refused = [&](const Arguments& options, const std::string& difference) {
        expect_failure(compress(bake_command(poses, bake, options)), 2,
                       {bake + ": holds another bake (" + difference, "choose another output"});
    };
    refused({"--rays", "32", "--bands", "3"}, "rays: 16 there, 32 asked for)");
    refused({"--rays", "16", "--bands", "4"}, "bands: 3 there, 4 asked for)");
    refused(quick({"--seed", "2"}), "seed: 1 there, 2 asked for)");
    refused(quick({"--sampler", "uniform"}), "sampler: cosine there, uniform asked for)");
    refused(quick({"--pose-noise", "shared"}), "streams: per-pose there, shared asked for)");
    refused(quick({"--noise-target", "10%"}), "transfer error: 0 there, 0.1 asked for)");
    refused(quick({"--albedo", "0.5"}), "checksum of faces and albedo: ");
    const auto file = directory_ / "plates" / "plates_0002.obj";
    const auto text = read_file(file, 1 << 20);
    write("plates/plates_0002.obj", std::string(text.begin(), text.end()) + "# changed\n");
    refused(kQuick, "pose 2: plates_0002.obj (");
    std::filesystem::remove(file);
    refused(kQuick, "poses: 4 there, 3 asked for)");
    expect_same(contents_of(bake), before);
}

TEST_F(Resume, FoldersOfOthersAreLeftAlone) {
    const std::string poses = make_poses("box", 1, 50);
    std::filesystem::create_directory(directory_ / "photos");
    write("photos/cat.jpg", "meow");
    const Contents before = contents_of(directory_.path());
    expect_failure(compress({"bake", poses, "-o", path("photos")}), 2,
                   {path("photos") + ": is not empty and not a bake"});
    expect_same(contents_of(directory_.path()), before);
}

}  // namespace
}  // namespace paim
