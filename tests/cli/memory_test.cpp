// What --memory promises: a bound of the peak memory, and the same bytes. A peak is that of the
// tool alone, on two threads, less the peak of the same tool when it has next to nothing to do. So
// code, libraries and threads do not count; --memory reserves kProgramBytes for them.
#include "analysis/bench/synthetic_bake.h"
#include "compressor/encode/memory/memory_plan.h"
#include "tests/cli/tool_test.h"
#include "tests/exr_files.h"

namespace paim {
namespace {

class Memory : public ToolTest {
  protected:
    static long peak_bytes(Arguments arguments) {
        arguments.insert(arguments.begin(), PAIM_COMPRESS);
        arguments.insert(arguments.end(), {"--threads", "2", "--json"});
        const ToolResult result = run(PAIM_PEAK_MEMORY, arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.exit_code == 0 ? std::stol(result.out) : 0;
    }

    // Encodes all components.
    Arguments encode(const std::string& bake, const std::string& output,
                     const Arguments& more) const {
        Arguments arguments{"encode",
                            path(bake),
                            "-o",
                            path(output),
                            "--geometry-components",
                            "all",
                            "--transfer-components",
                            "all"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }

    // The peak of the encoder when it has two poses of four vertices.
    long peak_bytes_of_nothing() const {
        bench::SyntheticBake{4, 2, 1}.write(directory_ / "tiny.bake");
        return peak_bytes(encode("tiny.bake", "tiny.paim", {}));
    }
};

TEST_F(Memory, StaysBelowTheLimitAndChangesNoByte) {
    // 450 poses of 33 blocks: 32 factors of 1.6 MB side by side, 52 MB, unless they must not be.
    bench::SyntheticBake{1200, 450, 5}.write(directory_ / "x.bake");
    constexpr long kLimit = 72'000'000;
    constexpr long kAllowed = kLimit - long{kProgramBytes};
    const long nothing = peak_bytes_of_nothing();
    std::filesystem::create_directory(path("limited"));
    std::filesystem::create_directory(path("unlimited"));
    const long limited = peak_bytes(encode("x.bake", "limited/x.paim", {"--memory", "72M"}));
    const long unlimited = peak_bytes(encode("x.bake", "unlimited/x.paim", {"--memory", "100G"}));
    EXPECT_LT(limited - nothing, kAllowed);
    // Otherwise the limit did nothing: the factors alone are more than it allows.
    EXPECT_GT(unlimited - nothing, kAllowed);
    expect_same(contents_of(path("limited")), contents_of(path("unlimited")));
}

// Poses are read, baked and written one after the other.
TEST_F(Memory, OfABakeDoesNotGrowWithItsPoses) {
    const auto peak = [&](const std::string& name, uint32_t num_poses) {
        const std::string poses = make_poses("octopus", num_poses, 5000);
        const long bytes = peak_bytes({"bake", poses, "-o", path(name + ".bake"), "--rays", "4"});
        std::filesystem::remove_all(poses);
        return bytes;
    };
    const long of_few = peak("few", 3);
    const long of_many = peak("many", 60);
    // A pose holds 5000 · (6 + 2 · 25) floats while it is baked, 1.1 MB, and about as much as text:
    // the 57 poses more would be 60 MB. Names, checksums and the allocator's leftovers may differ.
    EXPECT_LT(of_many, of_few + 8'000'000);
}

// What is said of gloss beforehand is what it takes: two halves, and what bounces keep of both meshes.
TEST_F(Memory, OfGlossIsSaidBeforeABake) {
    const std::string poses = make_poses("sphere", 1, 4000);
    write("still.obj", "mtllib a.mtl\nusemtl a\n" + text_of("sphere/sphere_0000.obj"));
    write("a.mtl", "newmtl a\nKd 0.5\nKs 0.1\nNs 9\n");
    const auto expect_said = [&](const Arguments& options) {
        const auto command = [&](const std::string& name, const Arguments& gloss) {
            Arguments arguments{"bake",   poses, "-o",      path(name + ".bake"),
                                "--rays", "2",   "--bands", "2"};
            arguments.insert(arguments.end(), options.begin(), options.end());
            arguments.insert(arguments.end(), gloss.begin(), gloss.end());
            return arguments;
        };
        const Arguments gloss{"--material", "phong:0.1,9", "--gloss-bands", "6,5", "--gloss"};
        const std::string err = compress(command("said", gloss)).err;
        const size_t at = err.find(" MB of memory");
        EXPECT_NE(at, std::string::npos) << err;
        if (at == std::string::npos) return 0L;
        const long said = 1'000'000 * std::stol(err.substr(err.rfind(' ', at - 1) + 1));
        const long took = peak_bytes(command("g", gloss)) - peak_bytes(command("d", {}));
        // Observed: within 3 MB. The rest are tables of the BRDF and what the allocator keeps.
        EXPECT_NEAR(took, said, 6'000'000);
        for (const std::string name : {"said", "g", "d"}) {
            std::filesystem::remove_all(path(name + ".bake"));
        }
        return said;
    };
    // Two halves of 900 planes of 4000 vertices are 29 MB.
    EXPECT_GT(expect_said({}), 29'000'000);
    EXPECT_GT(expect_said({"--bounces", "1"}), 5 * 14'400'000);
    EXPECT_GT(expect_said({"--bounces", "2", "--static", path("still.obj")}), 10 * 14'400'000);
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
    const auto command = [&](const std::string& memory) {
        return encode("x.bake", "x.paim", {"--measure", "--memory", memory});
    };
    expect_failure(compress(command("64M")), 3,
                   {"x.paim: 9", "MB are needed to measure it", "--memory allows 64 MB"});
    EXPECT_FALSE(std::filesystem::exists(path("x.paim")));
    const long nothing = peak_bytes_of_nothing();
    EXPECT_LT(peak_bytes(command("95M")) - nothing, 95'000'000 - long{kProgramBytes});
    EXPECT_TRUE(std::filesystem::exists(path("x.paim")));
}

// A map of the largest size would be 1.6 GB of floats.
TEST_F(Memory, OfALightDoesNotGrowWithItsMap) {
    constexpr int kWidth = 16384;
    constexpr int kHeight = 8192;
    Imf::Header header(kWidth, kHeight);
    header.compression() = Imf::ZIPS_COMPRESSION;
    const std::vector<uint16_t> line(kWidth, 0x3c00);  // ones as half floats
    Imf::FrameBuffer buffer;
    for (const char* name : {"R", "G", "B"}) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        buffer.insert(
            name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(const_cast<uint16_t*>(line.data())),
                             2, 0));  // the same line for all
    }
    {
        Imf::OutputFile file(path("large.exr").c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(kHeight);
    }
    write_exr_with(path("small.exr"), Image(64, 32, Vec3f::Ones()));
    const auto peak = [&](const std::string& name) {
        const ToolResult result = run(PAIM_PEAK_MEMORY, {PAIM_INFO, path(name)});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return result.exit_code == 0 ? std::stol(result.out) : 0;
    };
    // 4096 x 2048 pixels of 12 bytes are 101 MB, and 8 MiB of lines are read at a time.
    EXPECT_LT(peak("large.exr") - peak("small.exr"), 130'000'000);
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
