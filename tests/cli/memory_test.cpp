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
    EXPECT_GT(unlimited, 72'000'000);  // otherwise the limit did nothing
    expect_same(contents_of(path("limited")), contents_of(path("unlimited")));
}

TEST_F(Memory, TooManyPosesAreRefusedBeforeAnyWork) {
    bench::SyntheticBake{4, 700, 1}.write(directory_ / "long.bake");
    const Contents before = contents_of(directory_.path());
    expect_failure(compress({"encode", path("long.bake"), "-o", path("x.paim"), "--memory", "64M"}),
                   3, {"long.bake: 700 poses need", "MB of memory", "--memory allows 64 MB"});
    expect_same(contents_of(directory_.path()), before);
    // Few components need less, and then it is done.
    expect_success(
        compress({"encode", path("long.bake"), "-o", path("x.paim"), "--memory", "200M"}));
}

}  // namespace
}  // namespace paim
