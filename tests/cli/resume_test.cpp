// A bake that several processes share, or that is interrupted and resumed, has the same bytes as
// one made in a single run.
#include <map>

#include "tests/cli/tool_test.h"
#include "tests/directory_watch.h"

namespace paim {
namespace {

const Arguments kQuick{"--rays", "16", "--bands", "3"};

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

    // The process that bakes as with kQuick dies there (interrupted_bake.cpp): the signal.
    static int bake_until(const std::string& event, uint64_t place, const std::string& poses,
                          const std::string& output) {
        const ToolResult dead = run_tool({PAIM_INTERRUPTED_BAKE, poses, output, kQuick[1],
                                          kQuick[3], event, std::to_string(place)});
        return -dead.exit_code;
    }

    // When each pose of a bake was written.
    static std::map<std::string, std::filesystem::file_time_type> times_of_poses(
        const std::filesystem::path& bake) {
        std::map<std::string, std::filesystem::file_time_type> times;
        if (!std::filesystem::exists(bake)) return times;
        for (const auto& entry : std::filesystem::directory_iterator(bake)) {
            const std::string name = entry.path().filename().string();
            const bool is_pose = name.starts_with("pose_") && name.ends_with(".bin");
            if (is_pose) times[name] = entry.last_write_time();
        }
        return times;
    }

    static size_t num_unfinished_files(const std::filesystem::path& bake) {
        size_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator(bake)) {
            count += is_temporary_name(entry.path().filename().string());
        }
        return count;
    }
};

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

TEST_F(Resume, KilledWhileItWritesAPoseItGoesOnToTheSameBytes) {
    const std::string poses = make_poses("octopus", 4, 1000);
    expect_success(compress(bake_command(poses, path("whole.bake"), kQuick)));
    const std::string bake = path("killed.bake");
    expect_success(compress(bake_command(poses, bake, quick({"--poses", "0-1"}))));
    const auto half = std::filesystem::file_size(path("whole.bake/pose_000002.bin")) / 2;
    ASSERT_GT(half, std::filesystem::file_size(path("whole.bake/mesh.bin")));
    ASSERT_EQ(bake_until("writing", half, poses, bake), SIGXFSZ);
    EXPECT_EQ(times_of_poses(bake).size(), 2u);
    EXPECT_EQ(num_unfinished_files(bake), 1u);  // half of the third

    const ToolResult resumed = compress(bake_command(poses, bake, kQuick));
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_TRUE(contains(resumed.out, "(2 baked, 2 found)")) << resumed.out;
    expect_same(contents_of(bake), contents_of(path("whole.bake")));
}

// Finished poses are never lost nor baked again: their files stay those they were.
TEST_F(Resume, KilledTwentyTimesItLosesNothingButThePoseInFlight) {
    const std::string poses = make_poses("octopus", 16, 1000);
    expect_success(compress(bake_command(poses, path("whole.bake"), kQuick)));
    const auto mesh_bytes = std::filesystem::file_size(path("whole.bake/mesh.bin"));
    const auto pose_bytes = std::filesystem::file_size(path("whole.bake/pose_000000.bin"));
    const std::string bake = path("killed.bake");
    for (uint64_t round = 0; round < 20; ++round) {
        const auto before = times_of_poses(bake);
        const size_t num_before = before.size();
        switch (round % 4) {
            case 0: {  // anywhere in the file, but not yet in the mesh's
                const uint64_t place = mesh_bytes + (pose_bytes - 1 - mesh_bytes) * round / 19;
                ASSERT_EQ(bake_until("writing", place, poses, bake), SIGXFSZ) << round;
                EXPECT_EQ(num_unfinished_files(bake), 1u) << round;
                EXPECT_EQ(times_of_poses(bake).size(), num_before);
                break;
            }
            case 1:
                ASSERT_EQ(bake_until("reading", num_before, poses, bake), SIGKILL) << round;
                EXPECT_EQ(times_of_poses(bake).size(), num_before);
                break;
            case 2:  // the next but one: the next may be done before that is read, if hardly ever
                ASSERT_EQ(bake_until("reading", num_before + 1, poses, bake), SIGKILL) << round;
                EXPECT_LE(times_of_poses(bake).size(), num_before + 1);
                break;
            case 3:
                ASSERT_EQ(bake_until("after", num_before + 1, poses, bake), SIGKILL) << round;
                EXPECT_EQ(times_of_poses(bake).size(), num_before + 2);
                break;
        }
        const auto after = times_of_poses(bake);
        for (const auto& [name, time] : before) {
            ASSERT_TRUE(after.count(name)) << name << ", round " << round;
            EXPECT_EQ(after.at(name), time) << name << " was baked again in round " << round;
        }
    }
    const size_t num_finished = times_of_poses(bake).size();
    const ToolResult resumed = compress(bake_command(poses, bake, kQuick));
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_TRUE(contains(resumed.out, std::to_string(num_finished) + " found")) << resumed.out;
    expect_same(contents_of(bake), contents_of(path("whole.bake")));
}

// The tool itself, somewhere after its first pose: where does not matter.
TEST_F(Resume, KilledFromOutsideItGoesOnToTheSameBytes) {
    const std::string poses = make_poses("octopus", 8, 1000);
    const Arguments slow{"--rays", "512", "--bands", "3"};
    const Arguments command = bake_command(poses, path("killed.bake"), slow);
    std::filesystem::create_directory(path("killed.bake"));
    DirectoryWatch watch(path("killed.bake"));
    BackgroundTool tool(with_tool(command));
    ASSERT_TRUE(watch.wait_for("pose_000000.bin"));
    tool.kill();
    const int exit_code = tool.wait();
    EXPECT_TRUE(exit_code == -SIGKILL || exit_code == 0) << exit_code;
    const auto finished = times_of_poses(path("killed.bake"));
    EXPECT_TRUE(finished.count("pose_000000.bin"));

    const ToolResult resumed = compress(command);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    const std::string found = std::to_string(finished.size()) + " found)";
    EXPECT_TRUE(contains(resumed.out, found)) << resumed.out;
    for (const auto& [name, time] : times_of_poses(path("killed.bake"))) {
        if (finished.count(name) == 0) continue;
        EXPECT_EQ(time, finished.at(name)) << name << " was baked again";
    }
    expect_success(compress(bake_command(poses, path("whole.bake"), slow)));
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
    refused(quick({"--albedo", "0.5"}), "checksum of faces, albedo and texture: ");
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
