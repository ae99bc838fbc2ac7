// paim-analyze --verify of files with gloss, whose errors are stated apart.
#include <functional>

#include "paim/codec/gloss_asset.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/metrics/asset_error.h"
#include "tests/cli/gloss_tool.h"

namespace paim {
namespace {

using nlohmann::json;

class GlossVerify : public GlossTool {
  protected:
    // Plates shade each other, so that bakes have noise.
    void SetUp() override {
        expect_success(
            run(PAIM_POSES, {"plates", "-o", path("p"), "--poses", "3", "--vertices", "60"}));
    }

    ToolResult verify(const std::string& bake, const std::string& file,
                      Arguments options = {}) const {
        options.insert(options.begin(), {path(bake), "--verify", path(file)});
        return analyze(options);
    }

    // A file of one component and two bands of three, which states all of its errors.
    void make_coarse() const {
        bake_glossy("g.bake");
        encode("g.bake", "coarse.paim",
               {"--bands", "2", "--transfer-components", "1", "--geometry-components", "0"});
        const BakeReader bake(path("g.bake"));
        change("coarse.paim", "coarse.paim", [&](const Asset& asset, json& provenance) {
            const auto measured = [](const Asset& of, const BakeReader& with) {
                const BandPower natural = BandPower::natural();
                return json::parse(error_statement_json(measure_asset(of, with, natural), natural));
            };
            provenance["measured"] = measured(asset, bake);
            json gloss = measured(gloss_asset(asset), bake.gloss());
            for (const NamedError& error : named_errors({})) {
                if (!error.of_light) gloss.erase(error.name);
            }
            provenance["gloss"]["measured"] = gloss;
        });
    }

    void change(const std::string& from, const std::string& to,
                const std::function<void(const Asset&, json&)>& change_it) const {
        Asset asset = read_paim(path(from));
        json provenance = json::parse(asset.provenance_json);
        change_it(asset, provenance);
        asset.provenance_json = provenance.dump();
        write_paim(path(to), asset);
    }
};

TEST_F(GlossVerify, AcceptsAFileThatIsAsGoodAsItSays) {
    bake_glossy("g.bake");
    for (const std::string codec : {"svd", "cpca"}) {
        encode("g.bake", "x.paim",
               {"--max-error", "5%", "--max-gloss-error", "8%", "--codec", codec});
        const json report = parse_object(verify("g.bake", "x.paim", {"--json"}));
        EXPECT_EQ(report["within"], true);
        EXPECT_EQ(report["errors"].size(), 16u);
        EXPECT_EQ(report["gloss"]["light_spectrum"], "flat");
        EXPECT_EQ(report["gloss"]["bake_differences"], json::object());
        EXPECT_GT(report["gloss"]["bake_noise"], 0.0);
        EXPECT_NE(report["gloss"]["bake_noise"], report["bake_noise"]);
        const json& errors = report["gloss"]["errors"];
        // Those of the transfer and of the frames alone: the positions are those of the whole.
        EXPECT_EQ(errors.size(), 8u) << codec;
        for (const auto& [name, entry] : errors.items()) {
            const double stated = entry["stated"], measured = entry["measured"];
            if (name.starts_with("frames_")) {
                // Faces are added up in another order.
                EXPECT_NEAR(measured, stated, 1e-7 * stated) << codec << ' ' << name;
            } else {
                EXPECT_TRUE(name.starts_with("transfer_")) << name;
                // To the last bit, being measured twice in the same way.
                EXPECT_EQ(stated, measured) << codec << ' ' << name;
            }
            EXPECT_EQ(entry["within"], true) << codec << ' ' << name;
        }
        EXPECT_GT(errors["transfer_total_error"]["measured"], 0.05) << codec;
        EXPECT_LE(errors["transfer_total_error"]["measured"], 0.08) << codec;
        const ToolResult text = verify("g.bake", "x.paim");
        EXPECT_EQ(text.err, "");
        const std::string file = path("x.paim");
        EXPECT_TRUE(contains(text.out, "\n" + file + ", its gloss, against " + path("g.bake") +
                                           ", light spectrum flat\n"))
            << text.out;
        EXPECT_TRUE(text.out.ends_with("\n" + file + ": within what it states\n")) << text.out;
    }
}

TEST_F(GlossVerify, FindsEveryErrorThatIsLargerThanStated) {
    make_coarse();
    size_t num_of_light = 0;
    for (const NamedError& error : named_errors({})) {
        if (!error.of_light) continue;
        ++num_of_light;
        change("coarse.paim", "x.paim", [&](const Asset&, json& provenance) {
            json& stated = provenance["gloss"]["measured"][error.name];
            EXPECT_GT(stated, 0.0) << error.name;
            stated = stated.get<double>() * (1.0 - 1e-5);
        });
        const ToolResult result = verify("g.bake", "x.paim", {"--json"});
        EXPECT_EQ(result.exit_code, 5) << error.name << result.err;
        EXPECT_TRUE(contains(result.err, path("x.paim") + ": expected a " + error.name +
                                             " of the gloss of at most "))
            << result.err;
        const json report = json::parse(result.out);
        EXPECT_EQ(report["gloss"]["errors"][error.name]["within"], false) << error.name;
        EXPECT_EQ(report["errors"][error.name]["within"], true) << error.name;
        EXPECT_EQ(report["within"], false) << error.name;
        const std::string text = verify("g.bake", "x.paim").out;
        EXPECT_TRUE(contains(text, "  above\n")) << error.name;
        EXPECT_TRUE(text.ends_with(": above what it states: " + error.name + " of the gloss\n"))
            << text;
    }
    EXPECT_EQ(num_of_light, 6u);
    // Both kinds are counted.
    change("coarse.paim", "x.paim", [](const Asset&, json& provenance) {
        provenance["measured"]["e_rms"] = 0.0;
        provenance["gloss"]["measured"]["transfer_error"] = 0.0;
    });
    const ToolResult both = verify("g.bake", "x.paim");
    EXPECT_EQ(both.exit_code, 5);
    EXPECT_TRUE(contains(both.out, ": above what it states: e_rms, transfer_error of the gloss\n"))
        << both.out;
    EXPECT_TRUE(contains(both.err, "expected a e_rms of at most 0, ")) << both.err;
    EXPECT_TRUE(contains(both.err, " (2 errors are above)\n")) << both.err;
}

// The positions that gloss was encoded with are not in the file.
TEST_F(GlossVerify, NothingIsStatedOfPositionsThatAFileDoesNotHave) {
    bake_glossy("g.bake");
    for (const Arguments& options :
         {Arguments{"--max-error", "5%"}, {"--max-size", "40K"}, {"--measure"}}) {
        encode("g.bake", "x.paim", options);
        const json of_file = parse_object(info({path("x.paim"), "--json"}))["provenance"];
        EXPECT_TRUE(of_file["measured"].contains("position_rms"));
        for (const char* const member : {"measured", "targets"}) {
            EXPECT_EQ(of_file["gloss"].contains(member), of_file.contains(member));
            if (!of_file["gloss"].contains(member)) continue;
            EXPECT_TRUE(of_file["gloss"][member].contains("transfer_total_error"));
            for (const auto& [name, value] : of_file["gloss"][member].items()) {
                EXPECT_TRUE(name == "light_spectrum" || contains(name, "transfer")) << name;
            }
        }
        // For people, too, with what is measured of the gloss below its own heading.
        const std::string text = info({path("x.paim")}).out;
        const size_t gloss = text.find("\n  gloss:\n", text.find("\nprovenance:\n"));
        ASSERT_NE(gloss, std::string::npos) << text;
        EXPECT_NE(text.find("\n    measured:\n", gloss), std::string::npos) << text;
        EXPECT_NE(text.find("\n      transfer total error: ", gloss), std::string::npos) << text;
        expect_success(verify("g.bake", "x.paim"));
    }
}

TEST_F(GlossVerify, ComparesUnderTheLightThatWasMeant) {
    make_coarse();
    const json report = parse_object(verify("g.bake", "coarse.paim", {"--json"}));
    EXPECT_EQ(report["gloss"]["light_spectrum"], "natural");
    EXPECT_EQ(report["gloss"]["errors"]["transfer_error"]["within"], true);
    const ToolResult flat = verify("g.bake", "coarse.paim", {"--light-spectrum", "flat"});
    expect_success(flat);
    EXPECT_TRUE(contains(flat.out, "(what it does not state for this light is not compared)\n"));
    const json other =
        parse_object(verify("g.bake", "coarse.paim", {"--json", "--light-spectrum", "flat"}));
    EXPECT_TRUE(other["gloss"]["errors"]["transfer_error"]["stated"].is_null());
    EXPECT_GT(other["gloss"]["errors"]["transfer_error"]["measured"], 0.0);
}

TEST_F(GlossVerify, SaysWhereTheBakeIsAnother) {
    bake_glossy("g.bake");
    encode("g.bake", "x.paim", {"--max-error", "10%"});
    // The same rays, another lobe.
    expect_success(bake("m.bake", {"--material", "phong:0.5,2", "--gloss-bands", "3,2"}));
    const ToolResult other = verify("m.bake", "x.paim", {"--json"});
    EXPECT_EQ(other.exit_code, 5);
    EXPECT_TRUE(contains(other.err, "note: " + path("x.paim") +
                                        ": gloss: was made from another "
                                        "bake than " +
                                        path("m.bake") + ": bake_noise "))
        << other.err;
    EXPECT_TRUE(contains(other.err, "; it was made from another bake\n")) << other.err;
    const json report = json::parse(other.out);
    EXPECT_EQ(report["bake_differences"], json::object());
    EXPECT_TRUE(report["gloss"]["bake_differences"].contains("bake_noise"));

    // A file of a bake without gloss, and the other way round.
    expect_success(bake("d.bake"));
    encode("d.bake", "d.paim", {"--max-error", "10%"});
    const ToolResult without = verify("g.bake", "d.paim");
    expect_success(without);
    EXPECT_TRUE(contains(without.err, ": gloss none (here ")) << without.err;
    EXPECT_FALSE(contains(without.out, "its gloss")) << without.out;
    expect_failure(verify("d.bake", "x.paim"), 2,
                   {path("d.bake") + ": expected a file made from this bake, without gloss"});
}

TEST_F(GlossVerify, RefusesWhatCannotBeTold) {
    bake_glossy("g.bake");
    encode("g.bake", "x.paim", {"--max-error", "10%"});
    change("x.paim", "silent.paim",
           [](const Asset&, json& provenance) { provenance["gloss"].erase("measured"); });
    expect_failure(verify("g.bake", "silent.paim"), 2,
                   {"silent.paim: gloss: expected a file that states its errors"});
    change("x.paim", "bad.paim", [](const Asset&, json& provenance) {
        provenance["gloss"]["measured"]["transfer_error"] = "small";
    });
    expect_failure(verify("g.bake", "bad.paim"), 2, {"bad.paim: gloss", "transfer_error"});
    expect_success(bake("o.bake", {"--material", "phong:0.5,4", "--gloss-bands", "3,1"}));
    expect_failure(verify("o.bake", "x.paim"), 2, {"o.bake", "bands of outgoing radiance, got 2"});
}

}  // namespace
}  // namespace paim
