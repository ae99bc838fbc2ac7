// Floors, still meshes and bouncing light, through the tools.
#include <fmt/format.h>

#include "paim/format/bake/bake_directory.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/image/exr.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

class Scenes : public ToolTest {
  protected:
    // Bakes the shape's two poses with few rays and these options.
    ToolResult bake(const std::string& name, Arguments options,
                    const std::string& shape = "box") const {
        options.insert(options.begin(), {"bake", path(shape), "-o", path(name), "--rays", "16",
                                         "--bands", "2", "--json"});
        return compress(options);
    }
};

TEST_F(Scenes, FloorIsPartOfTheMeshAndOfTheIdentity) {
    make_poses("box", 2, 50);
    const auto plain = parse_object(bake("plain.bake", {}));
    const auto json = parse_object(
        bake("x.bake", {"--floor", "--floor-vertices", "100", "--floor-albedo", "0.5,0.25,0.125"}));
    const int num_floor = json["num_vertices"].get<int>() - plain["num_vertices"].get<int>();
    EXPECT_GT(num_floor, 50);
    EXPECT_LE(num_floor, 100);
    const std::string floor = json["floor"];
    EXPECT_TRUE(contains(floor, std::to_string(num_floor) + " vertices at y = -1.00")) << floor;
    EXPECT_TRUE(contains(floor, "albedo 0.5,0.25,0.125")) << floor;
    EXPECT_EQ(parse_object(info({path("x.bake"), "--json"}))["floor"], floor);
    const BakeReader reader(path("x.bake"));
    EXPECT_EQ(reader.albedo().values.back(), Vec3f(0.5f, 0.25f, 0.125f));

    // The same again finds it; any other floor, and none, are refused by name.
    const Arguments same{"--floor", "--floor-vertices", "100", "--floor-albedo", "0.5,0.25,0.125"};
    EXPECT_EQ(parse_object(bake("x.bake", same))["poses_resumed"], 2);
    expect_failure(bake("x.bake", {}), 2, {"(floor: " + floor + " there, none asked for)"});
    expect_failure(bake("x.bake", {"--floor"}), 2, {"(floor: " + floor + " there, "});
    expect_failure(bake("plain.bake", same), 2, {"(floor: none there, " + floor + " asked for)"});

    expect_success(compress({"encode", path("x.bake"), "-o", path("x.paim")}));
    EXPECT_EQ(read_paim(path("x.paim")).moving().topology.num_vertices, json["num_vertices"]);
}

TEST_F(Scenes, FarFromTheWorldsOriginAllCountFromOnePlace) {
    write("pose.obj", "v 1000000 0 0\nv 1000001 0 0\nv 1000000 1 0.25\nf 1 2 3\n");
    write("wall.obj", "v 1000000.125 3 0\nv 1000001 3 0\nv 1000000 4 0\nf 1 2 3\n");
    expect_success(compress({"bake", path("pose.obj"), "-o", path("x.bake"), "--rays", "2",
                             "--floor", "--static", path("wall.obj")}));
    const BakeReader reader(path("x.bake"));
    const double origin = reader.identity().origin.x();
    EXPECT_NEAR(origin, 1e6, 1.0);
    const BakedPose pose = reader.read_pose(0);
    EXPECT_EQ(pose.positions[0], static_cast<float>(1e6 - origin));
    EXPECT_EQ(reader.still_mesh()->pose.positions[0], static_cast<float>(1000000.125 - origin));
}

TEST_F(Scenes, TheFloorsHeightSaysWhereItIsCountedFrom) {
    write("high.obj", "v 0 1000000 0\nv 1 1000000 0\nv 0 1000001 0.25\nf 1 2 3\n");
    const ToolResult high =
        compress({"bake", path("high.obj"), "-o", path("high.bake"), "--rays", "2", "--floor"});
    expect_success(high);
    const double y = BakeReader(path("high.bake")).identity().origin.y();
    EXPECT_NEAR(y, 1e6, 2.0);
    EXPECT_TRUE(contains(high.out, fmt::format(" (y counted from the origin's, {})\n", y)))
        << high.out;
    // Where that is zero there is nothing to say, wherever it is to the side.
    write("side.obj", "v 1000000 -1 0\nv 1000001 -1 0\nv 1000000 1 0.25\nf 1 2 3\n");
    const ToolResult side =
        compress({"bake", path("side.obj"), "-o", path("side.bake"), "--rays", "2", "--floor"});
    ASSERT_EQ(BakeReader(path("side.bake")).identity().origin.y(), 0.0);
    EXPECT_TRUE(contains(side.out, "  on a floor of ")) << side.out;
    EXPECT_FALSE(contains(side.out, "origin")) << side.out;
}

TEST_F(Scenes, AlbedoIsThatOfThePosesAlone) {
    write("pose.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.25\nf 1 2 3\n");
    write("wall.obj", "v 3 0 0\nv 4 0 0\nv 3 1 0\nf 1 2 3\n");
    expect_success(compress({"bake", path("pose.obj"), "-o", path("x.bake"), "--rays", "2",
                             "--albedo", "0.25", "--floor", "--static", path("wall.obj")}));
    const BakeReader reader(path("x.bake"));
    EXPECT_EQ(reader.albedo().values.front(), Vec3f::Constant(0.25f));
    EXPECT_EQ(reader.albedo().values.back(), Vec3f::Constant(0.8f));
    EXPECT_EQ(reader.still_mesh()->albedo.at(0), Vec3f::Constant(0.8f));
}

TEST_F(Scenes, FloorOptionsNeedAFloorAndSenseOfScale) {
    make_poses("box", 1, 50);
    expect_failure(bake("x.bake", {"--floor-albedo", "1"}), 1, {"--floor-albedo", "--floor"});
    expect_failure(bake("x.bake", {"--floor", "--floor-vertices", "15"}), 1,
                   {"--floor-vertices", "16 to"});
    expect_failure(bake("x.bake", {"--floor", "--floor-albedo", "2"}), 1, {"--floor-albedo"});
}

TEST_F(Scenes, BouncesAreNamedAndColourCostsThreeChannels) {
    make_poses("plates", 3, 200);
    const auto size_of = [&](const std::string& name) {
        return static_cast<double>(std::filesystem::file_size(path(name)));
    };
    const Arguments grey{"--bounces", "2"}, red{"--bounces", "2", "--albedo", "0.9,0.1,0.1"};
    auto json = parse_object(bake("0.bake", {}, "plates"));
    EXPECT_EQ(json["channels"], 1);
    EXPECT_FALSE(json.contains("back_hits"));
    json = parse_object(bake("grey.bake", grey, "plates"));
    EXPECT_EQ(json["channels"], 1);
    EXPECT_EQ(json["bounces"], 2);
    json = parse_object(bake("red.bake", red, "plates"));
    EXPECT_EQ(json["channels"], 3);
    // A floor or still mesh with a colour is enough.
    json = parse_object(
        bake("floor.bake",
             {"--bounces", "1", "--floor", "--floor-vertices", "50", "--floor-albedo", "0,0,1"},
             "plates"));
    EXPECT_EQ(json["channels"], 3);

    expect_failure(bake("grey.bake", {}, "plates"), 2, {"(bounces: 2 there, 0 asked for)"});
    expect_failure(bake("0.bake", grey, "plates"), 2, {"(bounces: 0 there, 2 asked for)"});
    expect_failure(bake("x.bake", {"--bounces", "17"}, "plates"), 1, {"--bounces", "0 to 16"});
    EXPECT_EQ(parse_object(bake("red.bake", red, "plates"))["poses_resumed"], 3);

    const Arguments all{"--transfer-components", "all"};
    for (const std::string name : {"0", "grey", "red"}) {
        Arguments encode{"encode", path(name + ".bake"), "-o", path(name + ".paim")};
        encode.insert(encode.end(), all.begin(), all.end());
        expect_success(compress(encode));
    }
    // Transfer of 4 planes a channel, as f32 and, its noise, f16; positions and normals of 6.
    // Headers and metadata are a few hundred bytes.
    EXPECT_NEAR(size_of("grey.bake/pose_000000.bin"), size_of("0.bake/pose_000000.bin"), 100);
    EXPECT_NEAR(size_of("red.bake/pose_000000.bin") - size_of("grey.bake/pose_000000.bin"),
                200 * 8 * (4 + 2), 200);
    // Mean and the two components of three poses.
    EXPECT_NEAR(size_of("red.paim") - size_of("grey.paim"), 200 * 8 * 4 * 3, 400);
    json = parse_object(info({path("red.paim"), "--json"}));
    EXPECT_EQ(json["channels"], 3);
    EXPECT_EQ(json["provenance"]["bounces"], 2);
    EXPECT_EQ(parse_object(info({path("grey.bake"), "--json"}))["bounces"], 2);
    json = parse_object(analyze({path("red.bake"), "-o", path("report"), "--size", "32",
                                 "--components", "1", "--bands", "1", "--poses", "2", "--json"}));
    EXPECT_LT(json["transfer_components"][0]["visual_error"]["sky"], 1e-5);
#ifdef PAIM_PLAY
    expect_success(run(PAIM_PLAY, {path("red.paim"), "--snapshot", path("red.exr"), "--size",
                                   "64x48", "--background", "black"}));
    // Light that bounces off red is red: the picture over its own albedo is, too.
    const Image image = read_exr(path("red.exr"));
    Vec3f sum = Vec3f::Zero();
    for (const Vec3f& pixel : image.pixels) sum += pixel.cwiseQuotient(Vec3f(0.9f, 0.1f, 0.1f));
    expect_success(run(PAIM_PLAY, {path("0.paim"), "--snapshot", path("0.exr"), "--size", "64x48",
                                   "--background", "black"}));
    const Image plain = read_exr(path("0.exr"));
    Vec3f plain_sum = Vec3f::Zero();
    for (const Vec3f& pixel : plain.pixels) plain_sum += pixel / 0.8f;
    const Vec3f gain = sum.cwiseQuotient(plain_sum);
    EXPECT_GT(gain.x(), 1.05f);
    EXPECT_GT(gain.x(), gain.y() + 0.05f);
    EXPECT_GT(gain.y(), 0.99f);
#endif
}

TEST_F(Scenes, StaticFilesAreWithinATargetToo) {
    make_poses("plates", 3, 50);
    make_poses("box", 1, 400);
    const std::string wall = path("box/box_0000.obj");
    expect_success(compress({"bake", path("plates"), "-o", path("x.bake"), "--rays", "1024",
                             "--bands", "3", "--static", wall}));
    const ToolResult said =
        compress({"encode", path("x.bake"), "-o", path("x.paim"), "--max-error", "10%"});
    expect_success(said);
    EXPECT_TRUE(contains(said.out, "still meshes: transfer ")) << said.out;
    const Asset asset = read_paim(path("x.paim"));
    ASSERT_NE(asset.still(), nullptr);
    EXPECT_FALSE(asset.still()->transfer->matrix.holds_floats());
    const auto json =
        parse_object(analyze({path("x.bake"), "--verify", path("x.paim"), "--json"}))["errors"];
    for (const char* name : {"scenery_transfer_total_error", "scenery_position_worst"}) {
        EXPECT_TRUE(json[name]["within"]) << name;
        EXPECT_EQ(json[name]["stated"], json[name]["measured"]) << name;
    }
    EXPECT_LE(json["scenery_transfer_total_error"]["measured"], 0.1);

    // One that was changed is found out.
    Asset worse = asset;
    worse.still()->transfer->matrix.steps[0] *= 1.5f;
    write_paim(path("worse.paim"), worse);
    const ToolResult found = analyze({path("x.bake"), "--verify", path("worse.paim")});
    EXPECT_EQ(found.exit_code, 5);
    EXPECT_TRUE(contains(found.err, "expected a scenery_transfer_error of at most ")) << found.err;
}

TEST_F(Scenes, StaticFilesAreStoredOnceAndNamed) {
    make_poses("plates", 3, 50);
    make_poses("box", 1, 50);
    const std::string wall = path("box/box_0000.obj");
    write("tri.obj", "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\n");
    const Arguments two{"--static", wall, "--static", path("tri.obj")};
    auto json = parse_object(bake("x.bake", two, "plates"));
    EXPECT_EQ(json["scenery_vertices"], 56 + 3);  // 6 * 3² + 2 is the box nearest to 50
    EXPECT_EQ(parse_object(bake("x.bake", two, "plates"))["poses_resumed"], 3);
    expect_failure(bake("x.bake", {"--static", wall}, "plates"), 2,
                   {"(static files: 2 there, 1 asked for)"});
    write("tri.obj", "v 5 0 0\nv 6 0 0\nv 5 2 0\nf 1 2 3\n");
    expect_failure(bake("x.bake", two, "plates"), 2, {"(static file 1: tri.obj ("});
    expect_failure(bake("y.bake", {"--static", path("none.obj")}, "plates"), 2,
                   {path("none.obj") + ": cannot open"});

    expect_success(compress({"encode", path("x.bake"), "-o", path("x.paim"), "--bands", "1"}));
    const Asset asset = read_paim(path("x.paim"));
    const BakeReader reader(path("x.bake"));
    ASSERT_NE(asset.still(), nullptr);
    ASSERT_EQ(asset.still()->topology.num_vertices, 59u);
    EXPECT_EQ(asset.still()->positions.mean_floats(), reader.still_mesh()->pose.positions);
    const auto& baked = reader.still_mesh()->pose.transfer;  // of two bands, the first is kept
    EXPECT_EQ(asset.still()->transfer->matrix.mean_floats(),
              std::vector<float>(baked.begin(), baked.begin() + 59));
    for (const std::string file : {"x.bake", "x.paim"}) {
        EXPECT_EQ(parse_object(info({path(file), "--json"}))["scenery_triangles"], 109);
    }

    // A bake is all its files; one that does not belong to it is none of them.
    uint64_t size_bytes = 0;
    for (const auto& [name, bytes] : contents_of(path("x.bake"))) size_bytes += bytes.size();
    write("x.bake/notes.txt", "mine");
    EXPECT_EQ(parse_object(info({path("x.bake"), "--json"}))["size_bytes"], size_bytes);

    // The whole file shows the whole bake, with the still mesh; one band less is another picture.
    json = parse_object(analyze({path("x.bake"), "-o", path("report"), "--size", "32",
                                 "--components", "1", "--bands", "1", "--poses", "1", "--json"}));
    EXPECT_LT(json["bands"][0]["visual_error"]["sky"], 1e-5);
    EXPECT_GT(json["bands"][1]["visual_error"]["sky"], 1e-2);
}

}  // namespace
}  // namespace paim
