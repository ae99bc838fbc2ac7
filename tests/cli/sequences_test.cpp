// The whole road with real sequences: many shapes, materials, quads, parts and open sheets.
#include <algorithm>
#include <cctype>
#include <ostream>

#include "tests/cli/tool_test.h"

namespace paim {
namespace {

// As the README of the data says; quads count as two triangles.
struct Sequence {
    const char* name;
    uint32_t num_poses;
    uint32_t num_vertices;
};

void PrintTo(const Sequence& sequence, std::ostream* out) {
    *out << sequence.name;
}

class RealSequence : public ToolTest, public testing::WithParamInterface<Sequence> {};

TEST_P(RealSequence, GoesAllTheWay) {
    const Sequence& sequence = GetParam();
    const std::string name = sequence.name;
    const std::string poses = std::string(PAIM_UNPACKED_DATA_DIR) + "/" + name + "/" + name;
    auto json = parse_object(
        compress({"bake", poses, "-o", path("x.bake"), "--rays", "16", "--bands", "3", "--json"}));
    EXPECT_EQ(json["num_poses"], sequence.num_poses);
    EXPECT_EQ(json["num_vertices"], sequence.num_vertices);
    const double rays = json["rays_traced"];
    EXPECT_EQ(rays, 16.0 * sequence.num_poses *
                        (sequence.num_vertices -
                         json["vertices_without_normal"].get<double>() / sequence.num_poses));
    EXPECT_LT(json["rays_blocked"].get<double>(), 0.8 * rays);
    EXPECT_GT(json["rays_blocked"].get<double>(), 0.0);
    EXPECT_LT(json["relative_noise"].get<double>(), 0.3);

    json = parse_object(compress({"encode", path("x.bake"), "-o", path("x.paim"), "--json"}));
    for (const char* part : {"geometry", "transfer"}) {
        const char* error = std::string(part) == "geometry" ? "energy_error" : "signal_error";
        EXPECT_LT(json[part][error].get<double>(), 0.01) << part;
        EXPECT_GT(json[part]["components"].get<int>(), 0) << part;
        EXPECT_LT(json[part]["components"].get<uint32_t>(), sequence.num_poses) << part;
    }
    json = parse_object(info({path("x.paim"), "--json"}));
    EXPECT_EQ(json["num_poses"], sequence.num_poses);
    EXPECT_EQ(json["size_bytes"], std::filesystem::file_size(path("x.paim")));

    json = parse_object(analyze({path("x.bake"), "-o", path("out"), "--size", "32", "--poses", "2",
                                 "--components", "5", "--bands", "2", "--env",
                                 std::string(PAIM_DATA_DIR) + "/env/forest.exr", "--json"}));
    for (const char* curve : {"geometry_components", "transfer_components", "bands"}) {
        ASSERT_EQ(json[curve].size(), 2u) << curve;
        EXPECT_LT(json[curve][0]["visual_error"]["forest"].get<double>(), 1e-3) << curve;
        const double less = json[curve][1]["visual_error"]["forest"];
        EXPECT_GT(less, 0.0) << curve;
        EXPECT_LT(less, 1.0) << curve;
    }
#ifdef PAIM_PLAY
    json = parse_object(run(PAIM_PLAY, {path("x.paim"), "--snapshot", path("x.png"), "--size",
                                        "64x64", "--pose", "3", "--json"}));
    EXPECT_GT(std::filesystem::file_size(path("x.png")), 200u);
#endif
}

INSTANTIATE_TEST_SUITE_P(
    Data, RealSequence,
    testing::Values(Sequence{"horse-gallop", 48, 8431}, Sequence{"wolf", 21, 5075},
                    Sequence{"dembones_bone", 400, 754}, Sequence{"knight_2h_spin", 73, 2454},
                    Sequence{"robot_dance", 81, 1820}, Sequence{"blender_flag", 90, 6305}),
    [](const testing::TestParamInfo<Sequence>& tested) {
        std::string name = tested.param.name;
        std::replace_if(
            name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
        return name;
    });

}  // namespace
}  // namespace paim
