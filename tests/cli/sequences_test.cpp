// The whole road with real sequences: many shapes, materials, quads, parts and open sheets.
#include <algorithm>
#include <cctype>
#include <ostream>

#include "paim/format/paim/paim_read.h"
#include "tests/cli/tool_test.h"
#include "tests/kept_motion.h"

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
    // Of every vertex that moves by more than what cannot be seen.
    const BakeReader bake(path("x.bake"));
    const double seen = 10.0 * 2e-4 * diagonal_of(bake);
    EXPECT_GT(least_kept_motion(read_paim(path("x.paim")), bake, seen).share, 0.9);
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
    // Causes of error together: at most their sum, and at least the largest of them.
    json = parse_object(analyze({path("x.bake"), "-o", path("out"), "--size", "48", "--poses", "1",
                                 "--budget", path("x.paim"), "--reference-rays", "256", "--json"}));
    expect_causes_add_up(json["budget"]["lights"]["sky"]);
#ifdef PAIM_PLAY
    json = parse_object(run(PAIM_PLAY, {path("x.paim"), "--snapshot", path("x.png"), "--size",
                                        "64x64", "--pose", "3", "--json"}));
    EXPECT_GT(std::filesystem::file_size(path("x.png")), 200u);
#endif
}

// Sequences × targets × codecs: within the error that was asked for, held to what it states by the
// tool that verifies, and never larger than the paper's own storage at the same error.
TEST_P(RealSequence, MeetsEveryTargetWithEveryCodec) {
    const Sequence& sequence = GetParam();
    const std::string name = sequence.name;
    // Some poses, so that there are rays enough for small errors.
    constexpr size_t kPoses = 8;
    const std::filesystem::path folder =
        std::string(PAIM_UNPACKED_DATA_DIR) + "/" + name + "/" + name;
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".obj") files.push_back(entry.path().string());
    }
    std::sort(files.begin(), files.end());
    Arguments bake{"bake", "-o", path("x.bake"), "--rays", "512", "--bands", "4"};
    for (size_t j = 0; j < kPoses; ++j) bake.push_back(files[j * files.size() / kPoses]);
    expect_success(compress(bake));

    for (const std::string error : {"0.05", "0.1"}) {
        const auto encode = [&](const Arguments& options) {
            Arguments all{"encode",      path("x.bake"), "-o",    path("x.paim"),
                          "--max-error", error,          "--json"};
            all.insert(all.end(), options.begin(), options.end());
            auto json = parse_object(compress(all));
            EXPECT_LE(json["measured"]["transfer_total_error"].get<double>(), std::stod(error));
            const ToolResult verified = analyze({path("x.bake"), "--verify", path("x.paim")});
            EXPECT_EQ(verified.exit_code, 0) << verified.err;
            // Of every vertex that moves by more than the distance that is allowed.
            const double least = 10.0 * json["geometry_target"].get<double>();
            const KeptMotion kept =
                least_kept_motion(read_paim(path("x.paim")), BakeReader(path("x.bake")), least);
            EXPECT_GT(kept.share, 0.9) << kept.vertex;
            return json;
        };
        const auto paper = encode({"--precision", "f32"});
        for (const std::string codec : {"svd", "cpca"}) {
            const auto json = encode({"--codec", codec});
            EXPECT_EQ(json["codec"], codec);
            EXPECT_LT(json["size_bytes"].get<double>() * 4.0, paper["size_bytes"].get<double>())
                << codec << " " << error;
        }
        const auto fast = encode({"--prefer", "speed"});
        EXPECT_LT(fast["multiply_adds"].get<double>() * 2.0, paper["multiply_adds"].get<double>());
        EXPECT_LT(fast["size_bytes"].get<double>(), paper["size_bytes"].get<double>());
    }
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
