// What --memory promises: the peak memory of the whole process, and the same bytes.
#include <sys/resource.h>

#include "analysis/bench/synthetic_bake.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Memory : public ToolTest {
  protected:
    // Encodes all components below this limit; returns the process's peak memory in bytes.
    long peak_bytes(const std::string& bake, const std::string& output,
                    const std::string& memory) const {
        BackgroundTool tool({PAIM_COMPRESS, "encode", path(bake), "-o", path(output),
                             "--geometry-components", "all", "--transfer-components", "all",
                             "--memory", memory, "--json"});
        rusage usage{};
        EXPECT_EQ(tool.wait(&usage), 0);
        return usage.ru_maxrss * 1024;
    }
};

TEST_F(Memory, StaysBelowTheLimitAndChangesNoByte) {
    // 450 poses of 33 blocks: 32 factors of 1.6 MB side by side, unless they must not be.
    bench::SyntheticBake{1200, 450, 5}.write(directory_ / "x.bake");
    std::filesystem::create_directory(path("limited"));
    std::filesystem::create_directory(path("unlimited"));
    const long limited = peak_bytes("x.bake", "limited/x.paim", "72M");
    const long unlimited = peak_bytes("x.bake", "unlimited/x.paim", "100G");
    EXPECT_LT(limited, 72'000'000);
    // Otherwise the limit did nothing: 36 and 73 MB on two cores.
    EXPECT_GT(unlimited, limited / 4 * 5);
    expect_same(contents_of(path("limited")), contents_of(path("unlimited")));
}

// Poses are read, baked and written one after the other.
TEST_F(Memory, OfABakeDoesNotGrowWithItsPoses) {
    const auto peak = [&](const std::string& name, uint32_t num_poses) {
        const std::string poses = make_poses("octopus", num_poses, 5000);
        BackgroundTool tool(
            {PAIM_COMPRESS, "bake", poses, "-o", path(name + ".bake"), "--rays", "4", "--json"});
        rusage usage{};
        EXPECT_EQ(tool.wait(&usage), 0);
        std::filesystem::remove_all(poses);
        return usage.ru_maxrss * 1024;
    };
    const long of_few = peak("few", 3);
    const long of_many = peak("many", 60);
    // A pose holds 5000 · (6 + 2 · 25) floats while it is baked, 1.1 MB, and about as much as text:
    // the 57 poses more would be 60 MB. Names, checksums and the allocator's leftovers may differ.
    EXPECT_LT(of_many, of_few + 8'000'000);
}

TEST_F(Memory, TooManyPosesAreRefusedBeforeAnyWork) {
    bench::SyntheticBake{4, 700, 1}.write(directory_ / "long.bake");
    const Contents before = contents_of(directory_.path());
    expect_failure(compress({"encode", path("long.bake"), "-o", path("x.paim"), "--memory", "64M"}),
                   3,
                   {"long.bake: 700 poses of 4 vertices in 1 bands need", "MB of memory",
                    "--memory allows 64 MB"});
    expect_same(contents_of(directory_.path()), before);
    // Few components need less, and then it is done.
    expect_success(
        compress({"encode", path("long.bake"), "-o", path("x.paim"), "--memory", "200M"}));
}

// Three files of 4000 · 60 · 28 floats, 81 MB, and six more planes of 4000 · 60, 6 MB.
TEST_F(Memory, ThatMeasuringTakesIsAskedForBeforeAnythingIsWritten) {
    bench::SyntheticBake{4000, 60, 5}.write(directory_ / "x.bake");
    const auto command = [&](const std::string& memory) -> Arguments {
        return {"encode", path("x.bake"),          "-o",  path("x.paim"), "--geometry-components",
                "all",    "--transfer-components", "all", "--measure",    "--memory",
                memory};
    };
    expect_failure(compress(command("64M")), 3,
                   {"x.paim: 8", "MB are needed to measure it", "--memory allows 64 MB"});
    EXPECT_FALSE(std::filesystem::exists(path("x.paim")));
    Arguments enough = command("90M");
    enough.insert(enough.begin(), PAIM_COMPRESS);
    BackgroundTool tool(enough);
    rusage usage{};
    EXPECT_EQ(tool.wait(&usage), 0);
    EXPECT_LT(usage.ru_maxrss * 1024, 90'000'000);
    EXPECT_TRUE(std::filesystem::exists(path("x.paim")));
}

// Three times 6000 · 28 · 40 floats are 81 MB.
TEST_F(Memory, ThatEncodingTakesIsAskedForBeforeABake) {
    const std::string poses = make_poses("octopus", 40, 6000);
    const Arguments command{poses,
                            "-o",
                            path("late.paim"),
                            "--rays",
                            "2",
                            "--memory",
                            "64M",
                            "--measure",
                            "--geometry-components",
                            "all",
                            "--transfer-components",
                            "all"};
    expect_failure(compress(command), 3, {"late.paim: ", "needed to measure it"});
    EXPECT_FALSE(std::filesystem::exists(path("late.bake")));
}

}  // namespace
}  // namespace paim
