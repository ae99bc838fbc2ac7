// paim-analyze --verify: files that are as good as they say, files that are not, and files that
// cannot be told.
#include <cmath>
#include <functional>

#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/image/exr.h"
#include "paim/metrics/asset_error.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

using nlohmann::json;

class Verify : public ToolTest {
  protected:
    Verify() {
        make_bake("x.bake");
        expect_success(compress({"encode", path("x.bake"), "-o", path("encoded.paim"), "--bands",
                                 "2", "--transfer-components", "1", "--geometry-components", "0"}));
    }

    // The encoded file, which states what is measured of it, changed by `change`.
    std::string state(const BandPower& spectrum, const std::function<void(json&)>& change) {
        Asset asset = read_paim(path("encoded.paim"));
        const AssetError error = measure_asset(asset, BakeReader(path("x.bake")), spectrum);
        json provenance = json::parse(asset.provenance_json);
        provenance["measured"] = json::parse(error_statement_json(error, spectrum));
        change(provenance);
        asset.provenance_json = provenance.dump();
        write_paim(path("x.paim"), asset);
        return path("x.paim");
    }
    std::string state(const std::function<void(json&)>& change = [](json&) {}) {
        return state(BandPower::flat(3), change);
    }

    ToolResult verify(const std::string& file, Arguments options = {}) const {
        options.insert(options.begin(), {path("x.bake"), "--verify", file});
        return analyze(options);
    }
};

TEST_F(Verify, AcceptsAFileThatIsAsGoodAsItSays) {
    const std::string file = state();
    const ToolResult text = verify(file);
    EXPECT_EQ(text.exit_code, 0) << text.err;
    EXPECT_EQ(text.err, "");
    EXPECT_TRUE(
        text.out.starts_with(file + " against " + path("x.bake") + ", light spectrum flat\n"))
        << text.out;
    for (const std::string name : {"transfer_error", "transfer_worst_vertex_deviation", "kg_error",
                                   "e_rms", "position_relative_worst"}) {
        EXPECT_TRUE(contains(text.out, "\n  " + name + " ")) << text.out;
    }
    EXPECT_FALSE(contains(text.out, "above")) << text.out;
    EXPECT_TRUE(text.out.ends_with("\n" + file + ": within what it states\n")) << text.out;

    const ToolResult result = verify(file, {"--json"});
    EXPECT_EQ(result.err, "");
    const json report = parse_object(result);
    EXPECT_EQ(report["light_spectrum"], "flat");
    EXPECT_EQ(report["errors"].size(), 16u);
    EXPECT_EQ(report["within"], true);
    EXPECT_EQ(report["bake_differences"], json::object());
    for (const auto& [name, entry] : report["errors"].items()) {
        // To the last bit, being measured twice in the same way.
        EXPECT_EQ(entry["stated"], entry["measured"]) << name;
        EXPECT_EQ(entry["within"], true) << name;
    }
    // One band of three is not kept.
    EXPECT_GT(report["errors"]["transfer_deviation"]["measured"], 0.05);
    EXPECT_EQ(verify(file, {"--json", "--threads", "1"}).out, result.out);
}

// Every figure that is stated is looked at.
TEST_F(Verify, FindsEveryErrorThatIsLargerThanStated) {
    for (const NamedError& error : named_errors({})) {
        if (error.name.starts_with("normal_angle")) continue;  // 0: the plates do not turn
        const auto lower = [&](json& provenance) {
            json& stated = provenance["measured"][error.name];
            stated = stated.get<double>() * (1.0 - 1e-5);
        };
        const std::string file = state(BandPower::natural(), lower);
        const ToolResult result = verify(file, {"--json"});
        EXPECT_EQ(result.exit_code, 5) << error.name << result.err;
        EXPECT_TRUE(contains(result.err, file + ": expected a " + error.name + " of at most "))
            << result.err;
        const json report = json::parse(result.out);
        EXPECT_EQ(report["errors"][error.name]["within"], false) << error.name;
        EXPECT_EQ(report["within"], false) << error.name;
        const std::string text = verify(file).out;
        EXPECT_TRUE(contains(text, "  above\n")) << error.name;
        EXPECT_TRUE(text.ends_with(file + ": above what it states: " + error.name + "\n")) << text;
    }
}

TEST_F(Verify, NamesAllErrorsThatAreLargerThanStated) {
    const std::string file = state([](json& provenance) {
        for (const char* const name : {"transfer_error", "kg_error", "e_rms"}) {
            json& stated = provenance["measured"][name];
            stated = 0.5 * stated.get<double>();
        }
    });
    const ToolResult result = verify(file);
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_TRUE(contains(result.out, "above what it states: transfer_error, kg_error, e_rms\n"))
        << result.out;
    EXPECT_TRUE(contains(result.err, " (3 errors are above)\n")) << result.err;
}

// The mesh is the same, so that everything can be measured; but what is measured is another bake.
TEST_F(Verify, SaysWhereTheBakeIsAnother) {
    const std::string file = state();
    const auto bake = [&](const std::string& name, Arguments options) {
        options.insert(options.begin(), {"bake", path("plates"), "-o", path(name), "--bands", "3"});
        expect_success(compress(options));
        return path(name);
    };
    // Few rays: far from what the file was made from.
    const std::string coarse = bake("coarse.bake", {"--rays", "2", "--seed", "5"});
    const ToolResult result = analyze({coarse, "--verify", file});
    EXPECT_EQ(result.exit_code, 5) << result.err;
    EXPECT_TRUE(contains(result.err, "note: " + file + ": was made from another bake than " +
                                         coarse +
                                         ": rays 16 (here 2), seed 0000000000000001 (here "
                                         "0000000000000005), bake_noise "))
        << result.err;
    EXPECT_TRUE(contains(result.err, "; it was made from another bake\n")) << result.err;
    const json report = json::parse(analyze({coarse, "--verify", file, "--json"}).out);
    EXPECT_EQ(report["bake_differences"]["rays"], (json{{"file", "16"}, {"bake", "2"}}));
    EXPECT_FALSE(report["bake_differences"].contains("sampler"));

    // Options that are not there by default.
    const std::string bounced = bake("bounced.bake", {"--rays", "16", "--bounces", "2"});
    EXPECT_TRUE(contains(analyze({bounced, "--verify", file}).err, "bounces none (here 2)"));

    // Other poses of the same faces and options: their noise is another.
    const std::string poses = path("plates");
    std::filesystem::copy_file(poses + "/plates_0001.obj", poses + "/plates_0002.obj",
                               std::filesystem::copy_options::overwrite_existing);
    const std::string moved = bake("moved.bake", {"--rays", "16"});
    const ToolResult other = analyze({moved, "--verify", file});
    EXPECT_TRUE(contains(other.err, "was made from another bake than " + moved + ": bake_noise "))
        << other.err;
    EXPECT_FALSE(contains(other.err, "rays")) << other.err;

    // The very same poses and options, baked again.
    std::filesystem::remove_all(path("again.bake"));
    std::filesystem::copy(path("x.bake"), path("again.bake"));
    EXPECT_EQ(analyze({path("again.bake"), "--verify", file}).err, "");
    // Files that say nothing of their bake.
    const std::string silent = state([](json& provenance) {
        provenance = {{"measured", provenance["measured"]}};
    });
    EXPECT_EQ(verify(silent).err, "");
}

TEST_F(Verify, AllowsForRoundingAndForPessimism) {
    const auto scale = [](double factor) {
        return [factor](json& provenance) {
            for (auto& [name, value] : provenance["measured"].items()) {
                if (value.is_number()) value = value.get<double>() * factor;
            }
        };
    };
    EXPECT_EQ(verify(state(scale(1.0 - 5e-7))).exit_code, 0);
    EXPECT_EQ(verify(state(scale(2.0))).exit_code, 0);
}

TEST_F(Verify, ComparesUnderTheLightThatWasMeant) {
    const std::string natural = state(BandPower::natural(), [](json&) {});
    const json report = parse_object(verify(natural, {"--json"}));
    EXPECT_EQ(report["light_spectrum"], "natural");
    EXPECT_GT(report["errors"]["transfer_missing_bands"]["stated"], 0.0);
    // Another light is measured, and nothing is said about it.
    const json other = parse_object(verify(natural, {"--json", "--light-spectrum", "flat"}));
    EXPECT_TRUE(other["errors"]["transfer_error"]["stated"].is_null());
    EXPECT_GT(other["errors"]["transfer_error"]["measured"], 0.0);
    EXPECT_FALSE(other["errors"]["kg_error"]["stated"].is_null());
    EXPECT_TRUE(contains(verify(natural, {"--light-spectrum", "flat"}).out,
                         "within what it states (what it does not state for this light is not "
                         "compared)\n"));

    // A map must be given again.
    Image image(8, 4, Vec3f(1, 1, 1));
    image.at(0, 0) = Vec3f(9, 9, 9);
    write_exr(directory_ / "dawn.exr", image);
    const std::string dawn = state(parse_band_power(path("dawn.exr"), 3), [](json&) {});
    expect_failure(verify(dawn), 1, {"those under dawn.exr", "--light-spectrum"});
    EXPECT_EQ(verify(dawn, {"--light-spectrum", path("dawn.exr")}).exit_code, 0);
}

TEST_F(Verify, RefusesWhatCannotBeTold) {
    const auto remove = [](json& provenance) { provenance.erase("measured"); };
    expect_failure(verify(state(remove)), 2, {"x.paim: expected a file that states its errors"});
    const auto nothing = [](json& provenance) {
        provenance["measured"] = {{"light_spectrum", "flat"}};
    };
    expect_failure(verify(state(nothing)), 2, {"x.paim: expected a file that states its errors"});
    for (const json& bad : {json(-1.0), json("small"), json(nullptr)}) {
        const auto spoil = [&](json& provenance) { provenance["measured"]["e_rms"] = bad; };
        expect_failure(verify(state(spoil)), 2, {"x.paim", "e_rms"});
    }

    const std::string file = state();
    expect_failure(verify(path("none.paim")), 2, {"none.paim"});
    expect_failure(analyze({path("none.bake"), "--verify", file}), 2, {"none.bake"});
    expect_failure(verify(file, {"--light-spectrum", "neutral"}), 1, {"got 'neutral'"});
    expect_failure(verify(file, {"-o", path("out")}), 1, {"--verify", "--output"});
    expect_failure(verify(file, {"--components", "3"}), 1, {"--verify", "--components"});
    expect_failure(analyze({path("x.bake"), "-o", path("out"), "--light-spectrum", "flat"}), 1,
                   {"--light-spectrum", "--verify"});
    expect_failure(analyze({path("x.bake")}), 1, {"--output is required"});
}

TEST_F(Verify, RefusesADamagedBake) {
    const std::string file = state();
    const auto pose = bake_pose_file(path("x.bake"), 2);
    std::vector<char> bytes = read_file(pose, uint64_t{1} << 20);
    bytes[bytes.size() - 100] ^= 1;  // of its noise
    write_file(pose, std::string(bytes.begin(), bytes.end()));
    expect_failure(verify(file), 2, {"pose_000002.bin"});
}

TEST_F(Verify, RefusesAnotherAnimation) {
    const std::string file = state();
    const auto bake = [&](const std::string& shape, uint32_t num_poses, uint32_t bands) {
        const std::string name = path(shape + ".other.bake");
        std::filesystem::remove_all(name);
        std::filesystem::remove_all(path(shape));
        expect_success(compress({"bake", make_poses(shape, num_poses, 60), "-o", name, "--rays",
                                 "2", "--bands", std::to_string(bands)}));
        return name;
    };
    expect_failure(analyze({bake("plates", 3, 3), "--verify", file}), 2,
                   {"plates.other.bake", "3 poses, got 4"});
    expect_failure(analyze({bake("plates", 4, 1), "--verify", file}), 2,
                   {"plates.other.bake", "of 1 bands", "got 2"});
    expect_failure(analyze({bake("sphere", 4, 3), "--verify", file}), 2,
                   {"sphere.other.bake", "vertices, got 50"});
}

}  // namespace
}  // namespace paim
