// The whole road as a user walks it: paim-poses, paim-compress, paim-info, paim-analyze.
#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>

#include "paim/image/exr.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Road : public ToolTest {};

TEST_F(Road, OneGoGivesTheBytesOfBakeAndEncode) {
    const std::string poses = make_poses("plates", 4, 60);
    std::filesystem::create_directory(directory_ / "steps");
    const Arguments bake_options{"--rays", "16", "--bands", "3", "--seed", "7"};
    const Arguments encode_options{"--geometry-components", "1", "--transfer-components", "2"};
    Arguments one_go{poses, "-o", path("x.paim")};
    one_go.insert(one_go.end(), bake_options.begin(), bake_options.end());
    one_go.insert(one_go.end(), encode_options.begin(), encode_options.end());
    expect_success(compress(one_go));

    Arguments bake{"bake", poses, "-o", path("steps/x.bake")};
    bake.insert(bake.end(), bake_options.begin(), bake_options.end());
    expect_success(compress(bake));
    Arguments encode{"encode", path("steps/x.bake"), "-o", path("steps/x.paim")};
    encode.insert(encode.end(), encode_options.begin(), encode_options.end());
    expect_success(compress(encode));

    expect_same(contents_of(directory_ / "x.bake"), contents_of(directory_ / "steps/x.bake"));
    EXPECT_TRUE(read_file(path("x.paim"), 1 << 20) == read_file(path("steps/x.paim"), 1 << 20));
}

TEST_F(Road, DiscardsTheBakeWhenAsked) {
    const std::string poses = make_poses("box", 2, 50);
    expect_success(
        compress({poses, "-o", path("x.paim"), "--rays", "2", "--bands", "1", "--discard-bake"}));
    EXPECT_EQ(names_of(contents_of(directory_.path())),
              (Arguments{"box/", "box/box_0000.obj", "box/box_0001.obj", "x.paim"}));
}

TEST_F(Road, InfoDescribesFileAndBake) {
    const std::string bake = make_bake("x.bake");
    expect_success(compress({"encode", bake, "-o", path("x.paim")}));
    for (const std::string kind : {"paim", "bake"}) {
        const std::string file = path("x." + kind);
        const ToolResult result = info({file, "--json"});
        EXPECT_EQ(result.err, "");
        const auto json = parse_object(result);
        EXPECT_EQ(json["kind"], kind);
        EXPECT_EQ(json["file"], file);
        EXPECT_EQ(json["num_poses"], 4);
        EXPECT_EQ(json["bands"], 3);
        EXPECT_EQ(json["num_vertices"], 50);  // two grids of 5 x 5, the nearest to 60
        const ToolResult text = info({file});
        EXPECT_EQ(text.exit_code, 0);
        EXPECT_TRUE(contains(text.out, "num poses: 4\n")) << text.out;
    }
}

TEST_F(Road, CompressReportsInJson) {
    const std::string poses = make_poses("plates", 4, 60);
    const ToolResult both =
        compress({poses, "-o", path("x.paim"), "--rays", "16", "--bands", "3", "--json"});
    // No progress; but plates are open sheets, each of 16 edges round it.
    EXPECT_TRUE(both.err.starts_with("warning: mesh: 32 edges belong to one face: ")) << both.err;
    EXPECT_EQ(std::count(both.err.begin(), both.err.end(), '\n'), 1) << both.err;
    auto json = parse_object(both);
    EXPECT_EQ(json["bake"]["poses_baked"], 4);
    EXPECT_EQ(json["bake"]["rays_traced"], 16 * 4 * json["bake"]["num_vertices"].get<int>());
    EXPECT_EQ(json["encode"]["size_bytes"], std::filesystem::file_size(path("x.paim")));
    EXPECT_LT(json["encode"]["transfer"]["signal_error"], 0.01);

    json = parse_object(compress({"bake", poses, "-o", path("x.bake"), "--rays", "16", "--bands",
                                  "3", "--poses", "1-2", "--json"}));
    EXPECT_EQ(json["poses_baked"], 0);
    EXPECT_EQ(json["poses_resumed"], 2);
    json = parse_object(compress({"encode", path("x.bake"), "-o", path("y.paim"), "--json"}));
    EXPECT_EQ(json["paim"], path("y.paim"));
}

Arguments curve_header(const std::string& curve) {
    return {"light",
            curve,
            "all",
            "theory_error [fraction]",
            "energy_error [fraction]",
            "visual_error [fraction]",
            "visual_error_least [fraction]",
            "visual_error_median [fraction]",
            "visual_error_most [fraction]",
            "visual_error_deviation [fraction]",
            "worst_picture_pose",
            "worst_picture_view",
            "reference_noise [fraction]",
            "rmse [radiance]",
            "psnr [dB]",
            "position_rms [scene units]",
            "position_worst [scene units]",
            "worst_vertex",
            "worst_pose",
            "edge_distortion [fraction]",
            "normal_angle [degrees]",
            "transfer_error [fraction]",
            "size [bytes]",
            "decode [ms per pose]"};
}

// Every number of a line of a curve's CSV, to its digits, under the light "sky".
void expect_csv_is_in_json(const Arguments& row, const nlohmann::json& point,
                           const nlohmann::json& reference) {
    const auto& spread = point["visual_error_spread"]["sky"];
    const std::vector<nlohmann::json> numbers{point["theory_error"],
                                              point["energy_error"],
                                              point["visual_error"]["sky"],
                                              spread["least"],
                                              spread["median"],
                                              spread["most"],
                                              spread["deviation"],
                                              spread["worst_pose"],
                                              spread["worst_view"],
                                              reference["noise"]["sky"],
                                              point["rmse"]["sky"],
                                              point["psnr_db"]["sky"],
                                              point["position_rms"],
                                              point["position_worst"]["distance"],
                                              point["position_worst"]["vertex"],
                                              point["position_worst"]["pose"],
                                              point["edge_distortion"],
                                              point["normal_angle_deg"],
                                              point["transfer_error"],
                                              point["size_bytes"],
                                              point["decode_ms"]};
    ASSERT_EQ(row.size(), 3 + numbers.size());
    for (size_t n = 0; n < numbers.size(); ++n) {
        const std::string& text = row[3 + n];
        if (numbers[n].is_null()) {  // JSON has no infinity, and no "not a number"
            EXPECT_TRUE(text == "inf" || text == "nan") << n << ": " << text;
            continue;
        }
        const double value = numbers[n].get<double>();
        // The CSV has at least three digits.
        EXPECT_NEAR(std::stod(text), value, 5e-3 * std::abs(value)) << n;
    }
}

TEST_F(Road, AnalysisHoldsTogether) {
    const std::string bake = make_bake("x.bake");
    const ToolResult result = analyze({bake, "-o", path("out"), "--size", "16", "--poses", "2",
                                       "--components", "2,1", "--bands", "2,1", "--json"});
    EXPECT_EQ(result.err,  // plates move along one line
              "paim-analyze: note: geometry_components: 2 asked for, there are 1\n");
    const auto json = parse_object(result);
    const Contents contents = contents_of(path("out"));
    for (const auto& [name, bytes] : contents) EXPECT_FALSE(is_temporary_name(name)) << name;

    for (const std::string curve : {"geometry_components", "transfer_components", "bands"}) {
        const auto rows = read_csv("out/" + curve + ".csv");
        ASSERT_GE(rows.size(), 2u);
        EXPECT_EQ(rows[0], curve_header(curve));
        ASSERT_EQ(rows.size() - 1, json[curve].size());  // one light
        for (size_t j = 1; j < rows.size(); ++j) {
            ASSERT_EQ(rows[j].size(), rows[0].size());
            const auto& point = json[curve][j - 1];
            EXPECT_EQ(rows[j][0], "sky");
            EXPECT_EQ(rows[j][1], std::to_string(point["kept"].get<int>()));
            EXPECT_EQ(rows[j][2], j == 1 ? "yes" : "no");
            EXPECT_EQ(rows[j][22], std::to_string(point["size_bytes"].get<uint64_t>()));
            expect_csv_is_in_json(rows[j], point, json["reference"]);
        }
        // Everything kept loses nothing but rounding; less loses more, and saves bytes.
        EXPECT_LT(json[curve][0]["visual_error"]["sky"], 1e-5);
        EXPECT_LT(json[curve][0]["transfer_error"], 1e-6);
        EXPECT_LT(json[curve][0]["position_worst"]["distance"], 1e-6);
        for (size_t j = 1; j < json[curve].size(); ++j) {
            EXPECT_GT(json[curve][j]["energy_error"], json[curve][j - 1]["energy_error"]);
            EXPECT_LT(json[curve][j]["size_bytes"], json[curve][j - 1]["size_bytes"]);
        }
        for (const std::string suffix : {"", "_bytes", "_time"}) {
            EXPECT_EQ(text_of("out/" + curve + suffix + ".svg").rfind("<?xml", 0), 0u)
                << curve << suffix;
        }
    }
    EXPECT_EQ(json["bands"].size(), 3u);
    EXPECT_EQ(json["transfer_components"].size(), 3u);
    EXPECT_EQ(json["geometry_components"].size(), 1u);  // plates move along one line

    // index.html names files that are there, and all of them but itself.
    expect_page_names_all("out");
}

TEST_F(Road, NamesOfLightsAreNoCommandsForGnuplot) {
    const std::string bake = make_bake("x.bake");
    // A quote, and a line that gnuplot would run: it would write into the current folder.
    const std::string name = "it's\nset print 'ran'; print 1\n#.exr";
    write_exr(directory_ / name, Image(16, 8, Vec3f::Ones()));
    const auto result = analyze({"--size", "16", "--poses", "1", "-o", path("out"), "--components",
                                 "1", "--bands", "1", "--env", path(name), bake});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_FALSE(std::filesystem::exists("ran"));
    EXPECT_NE(text_of("out/bands.svg").find("it's set print"), std::string::npos);
}

TEST_F(Road, OneEnvironmentFollowsEachOption) {
    const std::string bake = make_bake("x.bake");
    write_exr(directory_ / "dawn.exr", Image(16, 8));
    std::filesystem::create_directory(directory_ / "noon");
    write_exr(directory_ / "noon/dawn.exr", Image(16, 8));  // two lights, although of one name
    const auto json = parse_object(
        analyze({"--json", "--size", "16", "--poses", "1", "-o", path("out"), "--components", "1",
                 "--bands", "1", "--env", path("dawn.exr"), "--env", path("noon/dawn.exr"), bake}));
    EXPECT_EQ(json["bands"][0]["visual_error"].size(), 2u);
    EXPECT_EQ(read_csv("out/bands.csv").size(), 1u + 2 * 2);  // header, lights x settings
}

TEST_F(Road, EveryToolExplainsItself) {
    const std::map<const char*, Arguments> words{
        {PAIM_COMPRESS,
         {"bake", "encode", "--rays", "--bands", "--albedo", "--discard-bake", "=512",
          "Exit codes: 0 ok, 1 usage, 2 bad input"}},
        {PAIM_INFO, {".bake directory", "--json", "Exit codes: 0 ok, 1 usage"}},
        {PAIM_ANALYZE,
         {"--env", "--components", "--size", "pixels", "degrees", "Exit codes: 0 ok"}}};
    for (const auto& [tool, parts] : words) {
        const ToolResult help = run(tool, {"--help"});
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_EQ(help.err, "");
        for (const std::string& part : parts) {
            EXPECT_TRUE(contains(help.out, part)) << tool << ": " << part;
        }
        const std::string name = std::filesystem::path(tool).filename().string();
        const ToolResult version = run(tool, {"--version"});
        EXPECT_EQ(version.exit_code, 0);
        EXPECT_TRUE(std::regex_match(version.out, std::regex(name + R"( \d+\.\d+\.\d+\n)")))
            << version.out;
        expect_failure(run(tool, {"x", "-o", path("y"), "--no-such-option"}), 1,
                       {"unknown option ", "--help"});
    }
    for (const char* command : {"bake", "encode"}) {
        const ToolResult help = compress({command, "--help"});
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_TRUE(contains(help.out, "--threads")) << help.out;
    }
}

TEST_F(Road, SaysItWithPlainLinesAwayFromTerminals) {
    const std::string poses = make_poses("box", 2, 50);
    const Arguments bake{"bake", poses, "-o", path("x.bake"), "--rays", "2", "--bands", "1"};
    const ToolResult loud = compress(bake);
    EXPECT_EQ(loud.exit_code, 0);
    EXPECT_TRUE(contains(loud.err, "baking: 2 poses in")) << loud.err;
    EXPECT_FALSE(contains(loud.err, "\r")) << loud.err;
    EXPECT_FALSE(contains(loud.err, "\x1b")) << loud.err;
    Arguments quiet = bake;
    quiet.push_back("--quiet");
    const ToolResult silent = compress(quiet);
    EXPECT_EQ(silent.err, "");
    EXPECT_TRUE(contains(silent.out, "(0 baked, 2 found)")) << silent.out;
}

}  // namespace
}  // namespace paim
