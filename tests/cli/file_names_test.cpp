// Names of files as they come: bytes that are not UTF-8, and outputs that are symbolic links.
#include <functional>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

// "é" in Latin-1, and a byte that no encoding of text has.
constexpr const char* kOdd = "caf\xe9\xff";

class FileNames : public ToolTest {
  protected:
    // JSON is UTF-8 whatever the names are: what is none becomes U+FFFD.
    void expect_json(const ToolResult& result, const std::string& what) const {
        ASSERT_EQ(result.exit_code, 0) << what << result.err;
        EXPECT_FALSE(contains(result.out, "\xff")) << what;
        EXPECT_TRUE(contains(result.out, "caf\xef\xbf\xbd")) << what << result.out;
        const auto json = nlohmann::json::parse(result.out, nullptr, false);
        EXPECT_TRUE(json.is_object() || json.is_array()) << what << result.out;
    }
};

TEST_F(FileNames, NeedNotBeUtf8WithAnyToolsJson) {
    const std::string odd = path(kOdd);
    expect_json(
        run(PAIM_POSES, {"plates", "-o", odd, "--poses", "2", "--vertices", "60", "--json"}),
        "paim-poses");
    const std::string bake = odd + ".bake", file = odd + ".paim", both = odd + "2.paim";
    for (const char* const number : {"_0000.obj", "_0001.obj"}) {
        std::filesystem::rename(odd + "/plates" + number, odd + "/" + kOdd + number);
    }
    const std::string wall = odd + "/" + kOdd + "_0000.obj";
    expect_json(compress({"bake", odd, "-o", bake, "--rays", "16", "--bands", "2", "--json"}),
                "bake");
    expect_json(compress({"bake", odd, "-o", odd + "3.bake", "--rays", "2", "--bands", "1",
                          "--static", wall, "--json"}),
                "bake --static");
    expect_json(compress({"encode", bake, "-o", file, "--max-error", "40%", "--json"}), "target");
    expect_json(compress({"encode", bake, "-o", both, "--measure", "--json"}), "encode");
    expect_json(compress({odd, "-o", both, "--rays", "2", "--bands", "1", "--json"}), "both");
    expect_json(info({file, "--json"}), "paim-info X.paim");
    expect_json(info({bake, "--json"}), "paim-info X.bake");
    expect_json(info({odd + "3.bake", "--json"}), "paim-info X.bake with a still mesh");
    expect_json(info({file, "--prefixes", "--json"}), "paim-info --prefixes");
    expect_json(analyze({bake, "--verify", file, "--json"}), "paim-analyze --verify");
    expect_json(analyze({bake, "-o", odd + ".report", "--size", "16", "--components", "1",
                         "--bands", "1", "--poses", "1", "--json"}),
                "paim-analyze");
    // Text has the names as they are.
    for (const ToolResult& result :
         {info({file}), info({bake}), info({odd + "3.bake"}), analyze({bake, "--verify", file})}) {
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_TRUE(contains(result.out, kOdd)) << result.out;
    }
#ifdef PAIM_PLAY
    expect_json(run(PAIM_PLAY, {file, "--snapshot", odd + ".png", "--size", "16x16", "--json"}),
                "paim-play --snapshot");
    expect_json(run(PAIM_PLAY, {file, "--bench", "1", "--size", "16x16", "--json"}),
                "paim-play --bench");
#endif
}

TEST_F(FileNames, OutputsThatAreLinksAreWrittenThrough) {
    const std::string bake = make_bake("x.bake");
    std::filesystem::create_directory(directory_ / "store");
    const auto link = [&](const std::string& target, const std::string& name) {
        std::filesystem::create_symlink(target, directory_ / name);
        return path(name);
    };
    write("store/old.paim", "not yet");
    for (const char* const name : {"old", "none"}) {  // an existing file, and one that is not there
        const std::string output =
            link(std::string("store/") + name + ".paim", std::string("link_") + name + ".paim");
        expect_success(compress({"encode", bake, "-o", output, "--max-error", "30%"}));
        EXPECT_TRUE(std::filesystem::is_symlink(output));
        expect_success(info({path(std::string("store/") + name + ".paim")}));
        // Measured and written again.
        expect_success(compress({"encode", bake, "-o", output, "--measure"}));
        EXPECT_TRUE(std::filesystem::is_symlink(output));
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_ / "store"), {}), 2);

    // A bake goes where the link leads, whether that is there or not.
    const std::string linked = link("store/far.bake", "far.bake");
    const Arguments again{path("plates"), "-o", path("far.paim"), "--rays", "2",
                          "--bands",      "1",  "--discard-bake"};
    expect_success(compress({"bake", path("plates"), "-o", linked, "--rays", "2", "--bands", "1"}));
    EXPECT_TRUE(std::filesystem::exists(directory_ / "store/far.bake/manifest.json"));
    expect_success(compress(again));
    EXPECT_FALSE(std::filesystem::exists(directory_ / "store/far.bake"));
    EXPECT_TRUE(std::filesystem::is_symlink(linked));
    expect_success(compress(again));

    expect_failure(
        compress({"encode", bake, "-o", link("loop.paim", "loop.paim"), "--max-error", "30%"}), 4,
        {path("loop.paim"), "Too many levels of symbolic links"});
    expect_failure(
        compress({"encode", bake, "-o", link("store", "folder.paim"), "--max-error", "30%"}), 4,
        {path("folder.paim"), "is a directory"});
    expect_failure(
        compress({"encode", bake, "-o", link("no/x.paim", "gone.paim"), "--max-error", "30%"}), 4,
        {path("gone.paim"), "does not exist"});
    expect_failure(
        compress({"encode", bake, "-o", link("/dev/null", "null.paim"), "--max-error", "30%"}), 4,
        {path("null.paim") + ": expected a regular file"});
}

}  // namespace
}  // namespace paim
