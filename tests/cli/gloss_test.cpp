// Gloss through the tools: what is said beforehand, files that meet both errors, curves.
#include <fmt/format.h>

#include <cmath>

#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "tests/cli/gloss_tool.h"

namespace paim {
namespace {

using nlohmann::json;

class Gloss : public GlossTool {
  protected:
    // The number of lines that say so of an option.
    static size_t num_unused(const ToolResult& result, const std::string& option) {
        expect_success(result);
        const std::string line = "note: " + option + " is not used: ";
        size_t count = 0;
        for (size_t at = result.err.find(line); at != std::string::npos;
             at = result.err.find(line, at + 1)) {
            ++count;
        }
        return count;
    }
};

TEST_F(Gloss, SaysBeforehandWhatItTakesAndLoses) {
    const ToolResult glossy =
        bake("g.bake", {"--material", "phong:0.5,400", "--gloss-bands", "3,2"});
    expect_success(glossy);
    expect_success(bake("d.bake"));
    const BakeReader reader(path("g.bake"));
    const size_t num_rows = reader.gloss_rows().size();
    EXPECT_EQ(num_rows, reader.identity().num_vertices);
    EXPECT_TRUE(contains(glossy.err, fmt::format("gloss: {} vertices of 27 coefficients (3 bands "
                                                 "of light, 2 of outgoing radiance, 1 channel)",
                                                 num_rows)))
        << glossy.err;
    EXPECT_TRUE(contains(glossy.err, "phong:0.5,400: 3 bands of light leave out")) << glossy.err;
    // f32 and f16 values, and at most a table entry and alignment for each of the two sections.
    const uint64_t more = size_of("g.bake/pose_000000.bin") - size_of("d.bake/pose_000000.bin");
    EXPECT_GE(more, 6 * 27 * num_rows);
    EXPECT_LE(more, 6 * 27 * num_rows + 1024);
    // The diffuse transfer is the same.
    EXPECT_EQ(reader.read_pose(1).transfer, BakeReader(path("d.bake")).read_pose(1).transfer);
}

// Bands are chosen before the bake, for the material that needs most of each, and are then as if they
// had been given.
TEST_F(Gloss, ChosenBandsAreThoseThatAreSaid) {
    const ToolResult chosen = bake("c.bake", {"--material", "phong:0.1,2"});
    expect_success(chosen);
    const TransferLayout layout = BakeReader(path("c.bake")).identity().gloss->layout;
    EXPECT_LT(layout.in_bands, 5u);  // fewer than the most that are chosen
    EXPECT_LT(layout.out_bands, 4u);
    EXPECT_TRUE(contains(chosen.err, fmt::format("({} bands of light, {} of outgoing radiance, ",
                                                 layout.in_bands, layout.out_bands)))
        << chosen.err;
    EXPECT_FALSE(contains(chosen.err, "leave out")) << chosen.err;
    expect_success(bake("g.bake", {"--material", "phong:0.1,2", "--gloss-bands",
                                   fmt::format("{},{}", layout.in_bands, layout.out_bands)}));
    expect_same(contents_of(path("c.bake")), contents_of(path("g.bake")));
}

TEST_F(Gloss, MatteMaterialsBakeAsBefore) {
    expect_success(bake("d.bake"));
    expect_success(bake("m.bake", {"--material", "matte"}));
    expect_same(contents_of(path("d.bake")), contents_of(path("m.bake")));
}

TEST_F(Gloss, OptionsWithoutEffectAreNamed) {
    EXPECT_EQ(num_unused(bake("d.bake", {"--gloss-bands", "3,2"}), "--gloss-bands"), 1u);
    EXPECT_EQ(num_unused(bake("d.bake", {"--gloss"}), "--gloss"), 1u);
    // Gloss that an option sets is none of a library.
    const ToolResult both =
        bake("g.bake", {"--material", "phong:0.1,4", "--gloss-bands", "3,2", "--gloss"});
    EXPECT_EQ(num_unused(both, "--gloss-bands"), 0u);
    EXPECT_EQ(num_unused(both, "--gloss"), 1u);

    write("still.obj", "mtllib m.mtl\nv -9 -9 -9\nv 9 -9 -9\nv 0 -9 9\nusemtl a\nf 1 3 2\n");
    write("m.mtl", "newmtl a\nKd 0.2\nKs 0.5\nNs 4\n");
    EXPECT_EQ(num_unused(bake("s.bake", {"--static", path("still.obj"), "--gloss"}), "--gloss"),
              0u);

    // Said once, before the bake and not after it.
    const auto both_steps = [&](const std::string& name, const Arguments& options) {
        Arguments arguments{path("p"),     "-o",  path(name),          "--rays", "64",
                            "--max-error", "20%", "--max-gloss-error", "30%",    "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return compress(arguments);
    };
    EXPECT_EQ(num_unused(both_steps("two.paim", {}), "--max-gloss-error"), 1u);
    EXPECT_EQ(
        num_unused(both_steps("glossy.paim", {"--material", "phong:0.1,4"}), "--max-gloss-error"),
        0u);
}

TEST_F(Gloss, FilesMeetBothErrors) {
    bake_glossy("g.bake");
    for (const char* codec : {"svd", "cpca"}) {
        const json report = encode(
            "g.bake", "x.paim", {"--max-error", "5%", "--max-gloss-error", "8%", "--codec", codec});
        EXPECT_LE(report["measured"]["transfer_total_error"].get<double>(), 0.05) << codec;
        // Coefficients and frames together.
        const double coefficients =
            report["gloss"]["measured"]["transfer_total_error"].get<double>();
        const double frames = report["gloss"]["frames"]["relative_rms"].get<double>();
        EXPECT_LE(std::hypot(coefficients, frames), 0.08) << codec;
        EXPECT_DOUBLE_EQ(report["gloss"]["error_with_frames"].get<double>(),
                         std::hypot(coefficients, frames));
        EXPECT_GT(frames, 0.0);
        EXPECT_LE(frames, 0.04);
        EXPECT_GT(report["gloss"]["measured"]["transfer_total_error"].get<double>(), 0.0);
        EXPECT_EQ(report["size_bytes"].get<uint64_t>(), size_of("x.paim"));
        const json held = parse_object(info({path("x.paim"), "--json"}));
        EXPECT_EQ(held["gloss"]["out_bands"], 2);
        EXPECT_EQ(held["gloss"]["transfer_codec"], codec);
        EXPECT_EQ(held["provenance"]["gloss"]["measured"]["transfer_total_error"],
                  report["gloss"]["measured"]["transfer_total_error"]);
        EXPECT_EQ(held["provenance"]["gloss"]["frames"], report["gloss"]["frames"]);
        EXPECT_EQ(read_paim(path("x.paim")).moving().gloss->num_rows,
                  held["num_vertices"].get<uint32_t>());
    }
    // Nothing is left of the parts that files are made from.
    for (const std::string& name : names_of(contents_of(path("")))) {
        EXPECT_FALSE(contains(name, "parts")) << name;
    }
}

TEST_F(Gloss, ErrorsThatCannotBeMetNameItsOptions) {
    // Two plates that shadow one another, of 16 rays.
    expect_success(
        compress({"bake", make_poses("plates", 4, 60), "-o", path("n.bake"), "--rays", "16",
                  "--bands", "3", "--material", "phong:0.1,4", "--gloss-bands", "3,2"}));
    const ToolResult result =
        compress({"encode", path("n.bake"), "-o", path("x.paim"), "--max-error", "50%",
                  "--max-gloss-error", "0.01%", "--quiet"});
    expect_failure(result, 5,
                   {"n.bake: a gloss error of 0.01 % is asked for, but ", "bake with more"});
    EXPECT_FALSE(contains(result.err, "transfer error")) << result.err;
}

TEST_F(Gloss, FilesWithoutATargetHaveItToo) {
    bake_glossy("g.bake");
    const json report = encode("g.bake", "x.paim", {"--measure"});
    EXPECT_GT(report["gloss"]["measured"]["transfer_total_error"].get<double>(), 0.0);
    const Asset asset = read_paim(path("x.paim"));
    ASSERT_TRUE(asset.moving().gloss.has_value());
    EXPECT_EQ(asset.moving().gloss->layout.out_bands, 2u);
}

// Of a body whose files are so large that their size falls with the error: that of the sphere goes up and
// down by 2 %, which is as much as from 10 % of error to 12 %.
TEST_F(Gloss, FilesOfASizeHaveBothKinds) {
    const std::string octopus = make_poses("octopus", 3, 1000);
    expect_success(compress({"bake", octopus, "-o", path("g.bake"), "--rays", "64", "--bands", "3",
                             "--material", "phong:0.5,4", "--gloss-bands", "3,2", "--quiet"}));
    const auto size =
        encode("g.bake", "x.paim", {"--max-error", "10%"})["size_bytes"].get<uint64_t>();
    const json report = encode("g.bake", "y.paim", {"--max-size", std::to_string(size)});
    EXPECT_LE(report["size_bytes"].get<uint64_t>(), size);
    EXPECT_EQ(report["size_bytes"].get<uint64_t>(), size_of("y.paim"));
    // As good as the file whose size it is, to the steps in which errors are tried.
    EXPECT_LE(report["measured"]["transfer_total_error"].get<double>(), 0.11);
    EXPECT_LE(report["gloss"]["measured"]["transfer_total_error"].get<double>(), 0.11);
    expect_failure(
        compress({"encode", path("g.bake"), "-o", path("z.paim"), "--max-size", "1K", "--quiet"}),
        5, {"--max-size asks for 1000 bytes"});
}

TEST_F(Gloss, HasErrorCurvesOfItsOwn) {
    bake_glossy("g.bake");
    const json report = parse_object(analyze({path("g.bake"), "-o", path("a"), "--gloss", "--size",
                                              "32", "--poses", "1", "--json", "--quiet"}));
    EXPECT_FALSE(report.empty());
    EXPECT_TRUE(std::filesystem::exists(path("a/index.html")));
    expect_failure(analyze({path("g.bake"), "-o", path("b"), "--gloss", "--held-out", "5%"}), 1,
                   {"--gloss: expected --curves"});
    expect_failure(analyze({path("g.bake"), "--verify", path("x.paim"), "--gloss"}), 1,
                   {"--gloss"});
    expect_success(bake("d.bake"));
    const ToolResult diffuse = compress({"encode", path("d.bake"), "-o", path("d.paim"), "--quiet",
                                         "--max-error", "10%", "--max-gloss-error", "5%"});
    expect_success(diffuse);
    EXPECT_TRUE(contains(diffuse.err, "--max-gloss-error is not used")) << diffuse.err;
    expect_failure(analyze({path("d.bake"), "-o", path("c"), "--gloss"}), 3,
                   {"no vertex of the poses is glossy"});
}

// Bands of outgoing radiance that a lobe hardly has are left out by the error that is asked for.
TEST_F(Gloss, BandsFollowFromTheError) {
    expect_success(bake("g.bake", {"--material", "phong:0.5,1", "--gloss-bands", "3,6"}));
    const auto out_bands = [&](const char* error) {
        encode("g.bake", "x.paim", {"--max-error", error, "--codec", "cpca"});
        expect_success(analyze({path("g.bake"), "--verify", path("x.paim"), "--quiet"}));
        return read_paim(path("x.paim")).moving().gloss->layout.out_bands;
    };
    const uint32_t coarse = out_bands("20%"), fine = out_bands("4%");
    EXPECT_LT(coarse, 6u);
    EXPECT_GE(fine, coarse);
}

// What a file states of its frames is measured again.
TEST_F(Gloss, FramesAreVerified) {
    bake_glossy("g.bake");
    encode("g.bake", "x.paim", {"--max-error", "5%"});
    const json report =
        parse_object(analyze({path("g.bake"), "--verify", path("x.paim"), "--json", "--quiet"}));
    const json& frames = report["gloss"]["errors"]["frames_relative_rms"];
    EXPECT_GT(frames["measured"].get<double>(), 0.0);
    EXPECT_NEAR(frames["measured"].get<double>(), frames["stated"].get<double>(), 1e-9);
    Asset asset = read_paim(path("x.paim"));
    json provenance = json::parse(asset.provenance_json);
    json& stated = provenance["gloss"]["frames"]["relative_rms"];
    stated = 0.5 * stated.get<double>();
    asset.provenance_json = provenance.dump();
    write_paim(path("y.paim"), asset);
    const ToolResult result = analyze({path("g.bake"), "--verify", path("y.paim"), "--quiet"});
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_TRUE(contains(result.err, "frames_relative_rms of the gloss")) << result.err;
}

// Three times 250 planes of 8000 vertices, each with its mean and 2 components, are 72 MB of floats; of
// diffuse transfer it is a 28th.
TEST_F(Gloss, FilesThatCannotBeMeasuredAreRefusedBeforeTheBake) {
    expect_success(run(PAIM_POSES, {"sphere", "-o", path("many"), "--poses", "3", "--vertices",
                                    "8000", "--json"}));
    const auto both = [&](const std::string& name, const Arguments& options) {
        Arguments arguments{path("many"),
                            "-o",
                            path(name),
                            "--rays",
                            "2",
                            "--bands",
                            "3",
                            "--memory",
                            "64M",
                            "--measure",
                            "--transfer-components",
                            "all",
                            "--quiet"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return compress(arguments);
    };
    expect_failure(both("g.paim", {"--material", "phong:0.1,4", "--gloss-bands", "5,4"}), 3,
                   {"g.paim", "--memory allows"});
    EXPECT_FALSE(std::filesystem::exists(path("g.bake")));
    expect_success(both("d.paim", {}));
}

TEST_F(Gloss, OtherMaterialsAreAnotherBake) {
    bake_glossy("g.bake");
    expect_failure(bake("g.bake", {"--material", "phong:0.5,5", "--gloss-bands", "3,2"}), 2,
                   {"gloss", "phong:0.5,5", "phong:0.5,4"});
    expect_failure(bake("h.bake", {"--material", "glass:1"}), 1, {"glass", "cook-torrance"});
}

}  // namespace
}  // namespace paim
