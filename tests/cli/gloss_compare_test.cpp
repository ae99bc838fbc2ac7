// paim-analyze --compare of files with gloss, with their bake and without it.
#include "tests/cli/gloss_tool.h"

namespace paim {
namespace {

using nlohmann::json;

class GlossCompare : public GlossTool {
  protected:
    // Files of the same diffuse transfer, whose gloss is good, bad and bad.
    void make_files() const {
        bake_glossy("g.bake");
        for (const auto& [name, error] : {std::pair("good.paim", "1%"), {"bad.paim", "30%"}}) {
            encode("g.bake", name, {"--max-error", "5%", "--max-gloss-error", error});
        }
    }

    Arguments compare(Arguments options = {}) const {
        Arguments arguments{"--compare",
                            path("good.paim"),
                            path("bad.paim"),
                            "-o",
                            path("out"),
                            "--size",
                            "48",
                            "--poses",
                            "2",
                            "--views",
                            "2",
                            "--json",
                            "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return arguments;
    }
    ToolResult compare_with_bake(Arguments options = {}) const {
        options.insert(options.begin(), path("g.bake"));
        return analyze(compare(options));
    }
};

TEST_F(GlossCompare, SaysThatGlossIsNotCompared) {
    make_files();
    const ToolResult result = compare_with_bake();
    const json files = parse_object(result)["compare"];
    EXPECT_EQ(files[0]["lights"], files[1]["lights"]);
    EXPECT_EQ(files[0]["errors"], files[1]["errors"]);
    EXPECT_TRUE(contains(result.err, "note: --compare does not compare gloss")) << result.err;
    expect_success(bake("d.bake"));
    encode("d.bake", "d.paim", {"--max-error", "5%"});
    const ToolResult diffuse = analyze({path("d.bake"), "--compare", path("d.paim"), "-o",
                                        path("d"), "--size", "32", "--poses", "1", "--quiet"});
    expect_success(diffuse);
    EXPECT_FALSE(contains(diffuse.err, "gloss")) << diffuse.err;
}

TEST_F(GlossCompare, ComparesGlossAlone) {
    make_files();
    const ToolResult result = compare_with_bake({"--gloss"});
    const json files = parse_object(result)["compare"];
    EXPECT_FALSE(contains(result.err, "does not compare")) << result.err;
    for (const json& file : files) {
        const std::string name = file["file"];
        const json stated = parse_object(info({name, "--json"}))["provenance"]["gloss"]["measured"];
        for (const char* const error : {"transfer_total_error", "transfer_deviation"}) {
            // Measured twice in the same way.
            EXPECT_EQ(file["errors"][error], stated[error]) << name;
        }
        EXPECT_EQ(file["size_bytes"], std::filesystem::file_size(name));
    }
    const auto seen = [&](size_t file) {
        return files[file]["lights"]["sky"]["visual_error"].get<double>();
    };
    // 1 % and 30 % of the RMS of the gloss: how much of it is seen depends on light and view. 0.7 % and
    // 21 % were observed.
    EXPECT_GT(seen(0), 0.0);
    EXPECT_LT(seen(0), 0.02);
    EXPECT_GT(seen(1), 5.0 * seen(0));
}

// What is played has gloss, seen from the cameras.
TEST_F(GlossCompare, WithoutABakePicturesHaveGloss) {
    make_files();
    const json files = parse_object(analyze(compare()))["compare"];
    EXPECT_EQ(files[0]["lights"]["sky"]["difference"], 0.0);
    // The diffuse transfer is the same. 5.6 % were observed: 21 % of the gloss.
    EXPECT_GT(files[1]["lights"]["sky"]["difference"], 0.02);
    EXPECT_EQ(files[0]["stated_transfer_total_error"], files[1]["stated_transfer_total_error"]);
}

}  // namespace
}  // namespace paim
