// paim-info --prefixes: the table, the JSON object, and files that have no prefixes.
#include <algorithm>

#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/format/paim/prefixes.h"
#include "paim/metrics/asset_error.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

using nlohmann::json;

class Prefixes : public ToolTest {
  protected:
    // x.paim, of a bake, with or without a statement of what is measured of it.
    explicit Prefixes() {
        make_bake("x.bake");
        expect_success(compress({"encode", path("x.bake"), "-o", path("x.paim"),
                                 "--transfer-components", "3", "--geometry-components", "1"}));
        asset_ = read_paim(path("x.paim"));
        error_ = measure_asset(asset_, BakeReader(path("x.bake")), BandPower::natural());
    }

    std::string state(bool stated) {
        json provenance = json::parse(asset_.provenance_json);
        provenance.erase("measured");
        if (stated) {
            provenance["measured"] =
                json::parse(error_statement_json(error_, BandPower::natural()));
        }
        asset_.provenance_json = provenance.dump();
        write_paim(path("x.paim"), asset_);
        return path("x.paim");
    }

    Asset asset_;
    AssetError error_;
};

TEST_F(Prefixes, AreListedWithBytesComponentsAndErrors) {
    const std::string file = state(true);
    const json report = parse_object(info({file, "--prefixes", "--json"}));
    const uint64_t size_bytes = std::filesystem::file_size(file);
    EXPECT_EQ(report["file"], file);
    EXPECT_EQ(report["size_bytes"], size_bytes);
    EXPECT_EQ(report["light_spectrum"], "natural");
    EXPECT_EQ(report["transfer_error_of_whole_file"], "stated");
    EXPECT_EQ(report["position_rms_of_whole_file"], "stated");
    const std::vector<Prefix> prefixes = read_prefixes(file);
    ASSERT_EQ(prefixes.size(), 5u);
    ASSERT_EQ(report["prefixes"].size(), prefixes.size());
    for (size_t j = 0; j < prefixes.size(); ++j) {
        const json& entry = report["prefixes"][j];
        EXPECT_EQ(entry["size_bytes"], prefixes[j].size_bytes);
        EXPECT_EQ(entry["geometry_components"], prefixes[j].geometry_components);
        EXPECT_EQ(entry["transfer_components"], prefixes[j].transfer_components);
        if (j == 0) continue;
        const json& previous = report["prefixes"][j - 1];
        EXPECT_LE(entry["transfer_error"], previous["transfer_error"]);
        EXPECT_LE(entry["position_rms"], previous["position_rms"]);
    }
    const json& last = report["prefixes"].back();
    EXPECT_EQ(last["size_bytes"], size_bytes);
    EXPECT_EQ(last["share_of_file"], 1.0);
    EXPECT_EQ(last["transfer_error"], error_.transfer.total());
    EXPECT_EQ(last["position_rms"], error_.geometry.rms());
}

// Read as such and measured against the bake, every prefix is as good as it is said to be.
TEST_F(Prefixes, HaveTheErrorsThatAreListed) {
    const std::string file = state(true);
    const json report = parse_object(info({file, "--prefixes", "--json"}));
    const BakeReader bake(path("x.bake"));
    for (size_t j = report["prefixes"].size(); j-- > 0;) {
        const json& entry = report["prefixes"][j];
        std::filesystem::resize_file(file, entry["size_bytes"].get<uint64_t>());
        const Asset asset = read_paim(file, {.prefix = true});
        const AssetError error = measure_asset(asset, bake, BandPower::natural());
        // Geometry has no noise: what is missing is orthogonal but for f32.
        const double rms = error.geometry.rms();
        EXPECT_NEAR(entry["position_rms"], rms, 1e-4 * rms + 1e-6);
        const double total = error.transfer.total();
        // 16 rays: noise is 14 % of this transfer. Shrinkage leaves what is missing nearly, not
        // quite, orthogonal to the rest of the error: 0.6 % off at most when this was written.
        EXPECT_NEAR(entry["transfer_error"], total, 0.02 * total);
    }
}

TEST_F(Prefixes, AreATableForPeople) {
    const ToolResult text = info({state(true), "--prefixes"});
    expect_success(text);
    EXPECT_EQ(text.err, "");
    EXPECT_TRUE(contains(text.out, "bytes  of file  geometry  transfer  transfer error"))
        << text.out;
    EXPECT_TRUE(contains(text.out, "  100.0 %         1         3")) << text.out;
    EXPECT_TRUE(contains(text.out, "under the light spectrum natural")) << text.out;
    EXPECT_FALSE(contains(text.out, "states no")) << text.out;
    EXPECT_FALSE(contains(text.out, "--json has all")) << text.out;
    EXPECT_EQ(std::count(text.out.begin(), text.out.end(), '\n'), 1 + 5 + 1);
}

TEST_F(Prefixes, OfFilesThatStateNothingSaySo) {
    const std::string file = state(false);
    const ToolResult text = info({file, "--prefixes"});
    expect_success(text);
    EXPECT_TRUE(contains(text.out, "states no error of its transfer")) << text.out;
    EXPECT_TRUE(contains(text.out, "states no RMS distance")) << text.out;
    const json report = parse_object(info({file, "--prefixes", "--json"}));
    EXPECT_EQ(report["transfer_error_of_whole_file"], "unknown");
    EXPECT_EQ(report["position_rms_of_whole_file"], "unknown");
    EXPECT_EQ(report["prefixes"].back()["transfer_error"], 0.0);
    EXPECT_GT(report["prefixes"].front()["transfer_error"], 0.0);
}

TEST_F(Prefixes, OfLongListsAreThinnedOutForPeopleOnly) {
    for (LowRank* matrix : {&asset_.moving().positions, &asset_.moving().transfer->matrix}) {
        const StoredValues component = matrix->components[0];
        matrix->num_poses = matrix->num_components = 40;
        matrix->components.assign(40, component);
        matrix->weights.assign(size_t{40} * 40, 0.0f);
        matrix->singular_values.assign(40, 1.0);
    }
    const std::string file = state(false);
    const ToolResult text = info({file, "--prefixes"});
    expect_success(text);
    EXPECT_TRUE(contains(text.out, "20 of 81 prefixes; --json has all.")) << text.out;
    EXPECT_TRUE(contains(text.out, "        0         0 ")) << text.out;
    EXPECT_TRUE(contains(text.out, "100.0 %        40        40 ")) << text.out;
    EXPECT_EQ(parse_object(info({file, "--prefixes", "--json"}))["prefixes"].size(), 81u);
}

TEST_F(Prefixes, AreOfWholeFilesOnly) {
    expect_failure(info({path("x.bake"), "--prefixes"}), 2, {"x.bake", "expected a .paim file"});
    const std::string file = state(true);
    std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
    expect_failure(info({file, "--prefixes"}), 2, {file, "the file is cut short"});
    expect_failure(info({file, "--prefixes", "--json"}), 2, {file, "the file is cut short"});
    expect_failure(info({"--prefixes"}), 1, {"FILE"});
}

}  // namespace
}  // namespace paim
