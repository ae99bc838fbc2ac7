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

}  // namespace
}  // namespace paim
