// What a sequence stands on and among, through the tools: floors, scenery and light that bounces.
#include "paim/format/bake_directory.h"
#include "paim/format/paim_file.h"
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
    EXPECT_EQ(read_paim(path("x.paim")).topology.num_vertices, json["num_vertices"]);
}

TEST_F(Scenes, FloorOptionsNeedAFloorAndSenseOfScale) {
    make_poses("box", 1, 50);
    expect_failure(bake("x.bake", {"--floor-albedo", "1"}), 1, {"--floor-albedo", "--floor"});
    expect_failure(bake("x.bake", {"--floor", "--floor-vertices", "15"}), 1,
                   {"--floor-vertices", "16 to"});
    expect_failure(bake("x.bake", {"--floor", "--floor-albedo", "2"}), 1, {"--floor-albedo"});
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
    const Model model = read_paim(path("x.paim"));
    const BakeReader reader(path("x.bake"));
    ASSERT_EQ(model.scenery.topology.num_vertices, 59u);
    EXPECT_EQ(model.scenery.positions, reader.scenery()->pose.positions);
    const auto& baked = reader.scenery()->pose.transfer;  // of two bands, the first is kept
    EXPECT_EQ(model.scenery.transfer, std::vector<float>(baked.begin(), baked.begin() + 59));
    for (const std::string file : {"x.bake", "x.paim"}) {
        EXPECT_EQ(parse_object(info({path(file), "--json"}))["scenery_triangles"], 109);
    }

    // All of the model shows all of the bake, scenery and all; one band less is another picture.
    json = parse_object(analyze({path("x.bake"), "-o", path("report"), "--size", "32",
                                 "--components", "1", "--bands", "1", "--poses", "1", "--json"}));
    EXPECT_LT(json["bands"][0]["visual_error"]["sky"], 1e-5);
    EXPECT_GT(json["bands"][1]["visual_error"]["sky"], 1e-2);
}

}  // namespace
}  // namespace paim
