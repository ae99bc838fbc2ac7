// From an error to a file: every file is within the error that was asked for, measured again by
// another tool. An error that cannot be met is refused with a message that names the best possible
// one.
#include <cmath>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

using nlohmann::json;

class Target : public ToolTest {
  protected:
    Target() {
        const std::string poses = make_poses("octopus", 6, 1000);
        expect_success(
            compress({"bake", poses, "-o", path("x.bake"), "--rays", "1024", "--bands", "4"}));
    }

    json encode(const std::string& name, Arguments options) const {
        options.insert(options.begin(), {"encode", path("x.bake"), "-o", path(name), "--json"});
        return parse_object(compress(options));
    }
    ToolResult try_to_encode(Arguments options) const {
        options.insert(options.begin(), {"encode", path("x.bake"), "-o", path("none.paim")});
        return compress(options);
    }
    int verify(const std::string& name) const {
        return analyze({path("x.bake"), "--verify", path(name), "--json"}).exit_code;
    }
};

TEST_F(Target, IsMetByEveryCodecAndPrecision) {
    double sizes[3][2] = {};
    const char* errors[] = {"2%", "5%", "0.1"};
    const double limits[] = {0.02, 0.05, 0.1};
    const char* codecs[] = {"svd", "cpca"};
    for (int e = 0; e < 3; ++e) {
        for (int c = 0; c < 2; ++c) {
            const json report = encode("x.paim", {"--max-error", errors[e], "--codec", codecs[c]});
            EXPECT_EQ(report["codec"], codecs[c]);
            EXPECT_LE(report["measured"]["transfer_total_error"].get<double>(), limits[e]);
            // Not far below either: an error that is allowed is used.
            EXPECT_GE(report["measured"]["transfer_total_error"].get<double>(), 0.9 * limits[e]);
            EXPECT_LE(report["measured"]["position_relative_rms"].get<double>(), limits[e] / 50.0);
            EXPECT_EQ(verify("x.paim"), 0) << errors[e] << codecs[c];
            sizes[e][c] = report["size_bytes"];
            EXPECT_EQ(sizes[e][c], std::filesystem::file_size(path("x.paim")));
        }
        for (const char* precision : {"f32", "f16"}) {
            const json report =
                encode("f.paim", {"--max-error", errors[e], "--precision", precision});
            EXPECT_LE(report["measured"]["transfer_total_error"].get<double>(), limits[e]);
            EXPECT_EQ(verify("f.paim"), 0) << errors[e] << precision;
            EXPECT_GT(report["size_bytes"].get<double>(), 2.0 * sizes[e][0]) << precision;
        }
    }
    for (int c = 0; c < 2; ++c) {
        EXPECT_GT(sizes[0][c], sizes[1][c]);
        EXPECT_GT(sizes[1][c], sizes[2][c]);
    }
    // What suits best is as small as the better of both, to the 1 % that it may give for speed.
    const double automatic = encode("x.paim", {"--max-error", "5%"})["size_bytes"];
    EXPECT_LE(automatic, 1.05 * std::min(sizes[1][0], sizes[1][1]));
}

TEST_F(Target, SpeedTakesTheFewestMultiplyAdds) {
    const json small = encode("x.paim", {"--max-error", "5%"});
    const json fast = encode("y.paim", {"--max-error", "5%", "--prefer", "speed"});
    EXPECT_EQ(fast["codec"], "cpca");
    EXPECT_LT(fast["multiply_adds"].get<int>(), small["multiply_adds"].get<int>() + 1);
    for (const json& candidate : fast["candidates"]) {
        EXPECT_GE(candidate["multiply_adds"].get<int>(), fast["multiply_adds"].get<int>());
    }
    EXPECT_EQ(verify("y.paim"), 0);
    const json held = parse_object(info({path("y.paim"), "--json"}));
    EXPECT_EQ(held["transfer_codec"], "cpca");
    EXPECT_EQ(held["clusters"], fast["clusters"]);
    EXPECT_EQ(held["cluster_components"], fast["cluster_components"]);
    EXPECT_EQ(held["vertex_order"], "local");
    EXPECT_TRUE(held["geometry"]["precision"] == "i8" || held["geometry"]["precision"] == "i16");
    const json limited = encode("z.paim", {"--max-error", "5%", "--max-decode-cost", "40"});
    EXPECT_LE(limited["multiply_adds"].get<int>(), 40);
    EXPECT_EQ(verify("z.paim"), 0);
}

TEST_F(Target, OfSizeIsMet) {
    const auto size = static_cast<uint64_t>(encode("x.paim", {"--max-error", "5%"})["size_bytes"]);
    const json report = encode("y.paim", {"--max-size", std::to_string(size)});
    EXPECT_LE(report["size_bytes"].get<uint64_t>(), size);
    // As good as the file whose size it is, but for the last halving of the interval.
    EXPECT_LE(report["measured"]["transfer_total_error"].get<double>(), 0.055);
    EXPECT_EQ(verify("y.paim"), 0);
    const json smaller = encode("y.paim", {"--max-size", std::to_string(size / 2)});
    EXPECT_LE(smaller["size_bytes"].get<uint64_t>(), size / 2);
    EXPECT_GT(smaller["measured"]["transfer_total_error"],
              report["measured"]["transfer_total_error"]);
}

TEST_F(Target, NaturalLightAllowsSmallerFilesUnderItsOwnMeasure) {
    // Few bands leave much of natural light out, which no file can get back.
    const json natural = encode("x.paim", {"--max-error", "15%", "--light-spectrum", "natural"});
    EXPECT_LE(natural["measured"]["transfer_total_error"].get<double>(), 0.15);
    EXPECT_EQ(verify("x.paim"), 0);
    expect_failure(try_to_encode({"--max-error", "1%", "--light-spectrum", "natural"}), 5,
                   {"its 4 bands leave out", "more --bands", "the best is"});
}

TEST_F(Target, ThatCannotBeMetIsRefusedWithTheBestThatCan) {
    expect_failure(try_to_encode({"--max-error", "0.01%"}), 5,
                   {"a transfer error of 0.01 %", "the bake's noise leaves", "at best", "--rays"});
    expect_failure(try_to_encode({"--max-error", "2%", "--bands", "2"}), 5,
                   {"2 of its 4 bands leave", "keep more --bands"});
    expect_failure(try_to_encode({"--max-error", "2%", "--max-decode-cost", "2"}), 5,
                   {"cannot be met with 2 multiply-adds"});
    expect_failure(try_to_encode({"--max-error", "2%", "--max-size", "3K"}), 5,
                   {"takes", "--max-size allows 3000"});
    expect_failure(try_to_encode({"--max-error", "5%", "--geometry-error", "0.0000001%"}), 5,
                   {"positions as floats have", "at best", "--geometry-error"});
    expect_failure(try_to_encode({"--max-size", "1K"}), 5, {"--max-size asks for 1000 bytes"});
    EXPECT_FALSE(std::filesystem::exists(path("none.paim")));
}

TEST_F(Target, IsTheSameOnAnyNumberOfThreads) {
    for (const char* codec : {"svd", "cpca"}) {
        // Of the same name, which is in the file.
        encode("x.paim", {"--max-error", "5%", "--codec", codec, "--threads", "1"});
        const auto one = read_file(path("x.paim"), 1 << 24);
        encode("x.paim", {"--max-error", "5%", "--codec", codec, "--threads", "2"});
        EXPECT_EQ(read_file(path("x.paim"), 1 << 24), one) << codec;
    }
}

TEST_F(Target, SaysWhatWasComparedAndWhy) {
    const ToolResult result = try_to_encode({"--max-error", "5%"});
    EXPECT_EQ(result.exit_code, 0);
    for (const char* part : {"multiply-adds per vertex", "  > ", "measured, 5 % allowed", "at best",
                             "worst vertex", "of the diagonal", "KG", "E_RMS"}) {
        EXPECT_TRUE(contains(result.out, part)) << part << " in " << result.out;
    }
}

TEST_F(Target, GoesAllTheWayInOneGo) {
    expect_success(compress({path("octopus"), "-o", path("whole.paim"), "--rays", "512", "--bands",
                             "3", "--max-error", "5%", "--quiet"}));
    EXPECT_EQ(analyze({path("whole.bake"), "--verify", path("whole.paim")}).exit_code, 0);
}

TEST_F(Target, RefusesWhatMakesNoSense) {
    expect_failure(try_to_encode({"--max-error", "0"}), 1, {"--max-error", "more than 0"});
    expect_failure(try_to_encode({"--max-error", "100%"}), 1, {"--max-error", "less than 1"});
    expect_failure(try_to_encode({"--codec", "cpca"}), 1, {"--codec", "--max-error or --max-size"});
    for (const char* option :
         {"--geometry-error", "--max-sted", "--max-normal-angle", "--max-vertex-error"}) {
        expect_failure(try_to_encode({option, "0.01"}), 1, {option, "needs --max-error"});
    }
    expect_failure(try_to_encode({"--max-error", "5%", "--max-sted", "0"}), 1, {"--max-sted"});
    expect_failure(try_to_encode({"--max-error", "5%", "--max-normal-angle", "200"}), 1,
                   {"--max-normal-angle"});
    expect_failure(try_to_encode({"--max-error", "5%", "--transfer-components", "3"}), 1,
                   {"--transfer-components"});
    expect_failure(try_to_encode({"--max-error", "5%", "--light-spectrum", "dim"}), 1, {"dim"});
    expect_failure(try_to_encode({"--max-error", "5%", "--codec", "wavelet"}), 1, {"wavelet"});
    expect_failure(try_to_encode({"--max-error", "5%", "--codec", "cpca", "--precision", "f32"}), 1,
                   {"codec cpca", "integers alone", "--precision auto"});
    // Before a long bake, not after it.
    expect_failure(compress({path("octopus"), "-o", path("late.paim"), "--max-error", "5%",
                             "--light-spectrum", "natrual"}),
                   1, {"natrual"});
    EXPECT_FALSE(std::filesystem::exists(path("late.bake")));
}

TEST_F(Target, FilesOfCountsStateTheirErrorsWhereAsked) {
    encode("x.paim", {"--transfer-components", "2", "--geometry-components", "2"});
    EXPECT_EQ(verify("x.paim"), 2);
    const json counted =
        encode("x.paim", {"--transfer-components", "2", "--geometry-components", "2", "--measure"});
    EXPECT_GT(counted["measured"]["transfer_total_error"], 0.01);
    EXPECT_EQ(counted["size_bytes"], std::filesystem::file_size(path("x.paim")));
    EXPECT_EQ(verify("x.paim"), 0);
    encode("x.paim", {"--precision", "f16", "--measure"});
    EXPECT_EQ(verify("x.paim"), 0);
}

}  // namespace
}  // namespace paim
