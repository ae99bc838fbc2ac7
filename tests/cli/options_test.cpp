// What the options of paim-compress do, through what the tools and the library read back.
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Options : public ToolTest {
  protected:
    nlohmann::json describe(const std::string& file) const {
        return parse_object(info({file, "--json"}));
    }
    nlohmann::json encode(const std::string& bake, Arguments options) const {
        const std::string output = path("x.paim");
        options.insert(options.begin(), {"encode", bake, "-o", output});
        expect_success(compress(options));
        return describe(output);
    }
    // A tetrahedron with normals that its faces do not have.
    void write_tetrahedron(const std::string& name) const {
        write(name,
              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -1\nvn 0 1 0\nvn 1 0 0\nvn 0 0 2\n"
              "f 1//1 3//3 2//2\nf 1//1 2//2 4//4\nf 2//2 3//3 4//4\nf 3//3 1//1 4//4\n");
    }
};

TEST_F(Options, OrderIsNaturalOrAsGiven) {
    write_tetrahedron("a_2.obj");
    write_tetrahedron("a_10.obj");
    const Arguments inputs{"bake", path("a_10.obj"), path("a_2.obj"), "--rays", "2", "--bands",
                           "1"};
    Arguments natural = inputs;
    natural.insert(natural.end(), {"-o", path("natural.bake")});
    expect_success(compress(natural));
    EXPECT_EQ(describe(path("natural.bake"))["first_pose"], "a_2.obj");
    EXPECT_EQ(describe(path("natural.bake"))["last_pose"], "a_10.obj");
    Arguments given = inputs;
    given.insert(given.end(), {"-o", path("given.bake"), "--keep-order"});
    expect_success(compress(given));
    EXPECT_EQ(describe(path("given.bake"))["first_pose"], "a_10.obj");
    EXPECT_EQ(describe(path("given.bake"))["last_pose"], "a_2.obj");
}

TEST_F(Options, NormalsComeFromFacesOrFile) {
    write_tetrahedron("a.obj");
    const auto normals = [&](const std::string& source) {
        const std::string bake = path(source + ".bake");
        expect_success(compress({"bake", path("a.obj"), "-o", bake, "--rays", "2", "--bands", "1",
                                 "--normals", source}));
        EXPECT_EQ(describe(bake)["normals"], source);
        return BakeReader(bake).read_pose(0).normals;
    };
    // Planes x, y, z over the four vertices: the file's, made unit.
    EXPECT_EQ(normals("file"), (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 1}));
    const std::vector<float> faces = normals("faces");
    for (const size_t plane : {0, 1, 2}) {
        // The three faces round the corner at the origin are alike.
        EXPECT_NEAR(faces[4 * plane], -1.0 / std::sqrt(3.0), 1e-6);
    }
}

TEST_F(Options, FormerNamesMeanTheSame) {
    const std::string poses = make_poses("plates", 2, 60);
    const auto bake = [&](const std::string& name, Arguments options) {
        const std::string output = path(name + ".bake");
        options.insert(options.begin(), {"bake", poses, "-o", output, "--bands", "2"});
        expect_success(compress(options));
        return contents_of(output);
    };
    const std::vector<std::pair<std::string, std::string>> names{
        {"independent", "per-pose"}, {"shared", "shared"}, {"mixed", "mixed"}};
    for (const auto& [name, former] : names) {
        const std::string a = name + "_new", b = name + "_former";
        const Contents now = bake(a, {"--pose-noise", name, "--noise-target", "30%"});
        expect_same(now, bake(b, {"--streams", former, "--transfer-error", "30%"}));
        // Bakes record the former name, so that those of both read alike.
        EXPECT_EQ(describe(path(a + ".bake"))["streams"], former);
        EXPECT_EQ(describe(path(a + ".bake"))["transfer_error"], 0.3);
    }
    const ToolResult help = compress({"bake", "--help"});
    EXPECT_NE(help.out.find("--pose-noise {independent,shared,mixed}=independent"),
              std::string::npos);
    for (const char* former : {"--streams", "--transfer-error"}) {
        EXPECT_EQ(help.out.find(former), std::string::npos) << former;
    }
}

TEST_F(Options, AlbedoIsGivenOrTheVertexColours) {
    const std::string poses = make_poses("octopus", 1, 1000);
    const Arguments quick{poses,     "-o", path("x.paim"),  "--rays", "2",
                          "--bands", "1",  "--discard-bake"};
    expect_success(compress(quick));
    EXPECT_EQ(describe(path("x.paim"))["albedo"], "per vertex");
    Arguments uniform = quick;
    uniform.insert(uniform.end(), {"--albedo", "0.25,0.5,0.75"});
    expect_success(compress(uniform));
    EXPECT_EQ(describe(path("x.paim"))["albedo"], "uniform");
    EXPECT_EQ(read_paim(path("x.paim")).moving().albedo.values,
              (std::vector<Vec3f>{{0.25f, 0.5f, 0.75f}}));
}

TEST_F(Options, ComponentsAreCountedAllOrChosen) {
    const std::string bake = make_bake("x.bake");  // 4 poses: rank 3 of the transfer, 1 of geometry
    auto json = encode(bake, {"--transfer-components", "2", "--geometry-components", "0"});
    EXPECT_EQ(json["transfer"]["components"], 2);
    EXPECT_EQ(json["geometry"]["components"], 0);
    EXPECT_NEAR(json["geometry"]["energy_error"], 1.0, 1e-12);  // all that moves is lost
    json = encode(bake, {"--transfer-components", "all", "--geometry-components", "all"});
    EXPECT_EQ(json["transfer"]["components"], 3);
    EXPECT_EQ(json["geometry"]["components"], 1);
    EXPECT_LT(json["transfer"]["energy_error"], 1e-12);
    json = encode(bake, {"--transfer-components", "1000"});
    EXPECT_EQ(json["transfer"]["components"], 3);
    const auto report = [&](const std::string& components) {
        return parse_object(compress(
            {"encode", bake, "-o", path("x.paim"), "--json", "--transfer-components", components}));
    };
    json = report("auto");
    EXPECT_EQ(json["geometry"]["components"], 1);
    EXPECT_LT(json["transfer"]["signal_error"], 0.01);
    EXPECT_LE(json["transfer"]["components"], json["transfer"]["above_noise"]);
    const int chosen = json["transfer"]["components"];
    ASSERT_GT(chosen, 0);
    const std::string fewer = std::to_string(chosen - 1);
    EXPECT_GE(report(fewer)["transfer"]["signal_error"], 0.01);
}

TEST_F(Options, HalfPrecisionHalvesTheComponents) {
    const std::string bake = make_bake("x.bake");
    const Arguments all{"--transfer-components", "all", "--geometry-components", "all"};
    const auto exact = encode(bake, all);
    EXPECT_EQ(exact["transfer"]["precision"], "f32");
    Arguments half_options = all;
    half_options.insert(half_options.end(), {"--precision", "f16"});
    const auto half = encode(bake, half_options);
    EXPECT_EQ(half["transfer"]["precision"], "f16");
    EXPECT_EQ(half["geometry"]["precision"], "f16");
    // 3 components of 9 planes and 1 of 3 planes over 50 vertices, 2 bytes less a number; each of
    // the 4 sections is padded to 64 bytes, which may give or take up to 63.
    const int saved = exact["size_bytes"].get<int>() - half["size_bytes"].get<int>();
    EXPECT_NEAR(saved, 2 * 50 * (3 * 9 + 1 * 3), 4 * 63);
}

TEST_F(Options, FewerBandsAreTheFirstPlanes) {
    expect_success(compress({"bake", make_poses("plates", 4, 60), "-o", path("x.bake"), "--rays",
                             "16", "--bands", "5"}));
    const auto json = encode(path("x.bake"), {"--bands", "3", "--transfer-components", "all"});
    EXPECT_EQ(json["bands"], 3);
    EXPECT_EQ(json["provenance"]["bake_bands"], 5);
    const ToolResult more =
        compress({"encode", path("x.bake"), "-o", path("9.paim"), "--bands", "9"});
    expect_success(more);
    EXPECT_TRUE(contains(more.err, "note: --bands 9: the bake has 5, which are all kept"))
        << more.err;
    EXPECT_EQ(describe(path("9.paim"))["bands"], 5);

    expect_success(compress({"encode", path("x.bake"), "-o", path("3.paim"), "--bands", "3",
                             "--transfer-components", "all"}));
    const Asset asset = read_paim(path("3.paim"));
    const BakeReader bake(path("x.bake"));
    MeshDecoder decoder(asset.moving());
    DecodedPose pose;
    for (uint32_t p = 0; p < 4; ++p) {
        decoder.decode(p, {}, pose);
        const BakedPose baked = bake.read_pose(p);
        ASSERT_EQ(pose.transfer.size(), 9u * 50u);
        // Transfer is at most 1; the mean and three products are rounded to 2^-24 a few times.
        for (size_t j = 0; j < pose.transfer.size(); ++j) {
            EXPECT_NEAR(pose.transfer[j], baked.transfer[j], 16 * 0x1p-24) << p << ' ' << j;
        }
    }
}

TEST_F(Options, FramesPerSecondAndNameTravelAlong) {
    const auto json = encode(make_bake("x.bake"), {"--fps", "12.5"});
    EXPECT_EQ(json["frames_per_second"], 12.5);
    EXPECT_EQ(json["name"], "x");
}

}  // namespace
}  // namespace paim
