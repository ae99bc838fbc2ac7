// A body that walks, on the whole road: what is taken out, what is said, what plays.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "paim/codec/playback.h"
#include "paim/format/paim/paim_read.h"
#include "paim/mesh/bounds.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

using nlohmann::json;

class RootMotionTool : public ToolTest {
  protected:
    static constexpr int kPoses = 9, kRings = 9, kSegments = 8;

    RootMotionTool() { write_walk("walk", -1); }

    // A tube 2 units tall that walks 5 units along x from pose to pose. Its upper half swings by 0.3
    // along z.
    // bad_pose  in which the first vertex is far away; -1: none
    // start     of the path along x
    void write_walk(const std::string& folder, int bad_pose, double start = 0.0,
                    const std::string& bad_vertex = "v 5000 4000 0\n") const {
        std::filesystem::create_directory(directory_ / folder);
        for (int p = 0; p < kPoses; ++p) {
            std::string text;
            for (int ring = 0; ring < kRings; ++ring) {
                const double y = 0.25 * ring;
                for (int segment = 0; segment < kSegments; ++segment) {
                    if (p == bad_pose && ring == 0 && segment == 0) {
                        text += bad_vertex;
                        continue;
                    }
                    const double angle = 2.0 * kPi * segment / kSegments;
                    text += fmt::format("v {:.9f} {:.9f} {:.9f}\n",
                                        start + 5.0 * p + 0.2 * std::sin(angle), y,
                                        0.2 * std::cos(angle) + swing(p, y));
                }
            }
            for (int ring = 0; ring + 1 < kRings; ++ring) {
                for (int segment = 0; segment < kSegments; ++segment) {
                    const auto number = [&](int r, int s) {
                        return 1 + r * kSegments + s % kSegments;
                    };
                    text += fmt::format("f {} {} {} {}\n", number(ring, segment),
                                        number(ring, segment + 1), number(ring + 1, segment + 1),
                                        number(ring + 1, segment));
                }
            }
            write(fmt::format("{}/{}.obj", folder, p), text);
        }
    }

    static double swing(int p, double y) {
        return 0.3 * std::max(0.0, y - 1.0) * std::sin(2.0 * kPi * p / kPoses);
    }

    // With default settings of the encoder.
    json make(const std::string& name, const Arguments& options,
              const std::string& folder = "walk") const {
        Arguments arguments{path(folder), "-o",     path(name + ".paim"), "--rays", "32", "--bands",
                            "3",          "--json", "--measure"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return parse_object(compress(arguments));
    }
};

TEST_F(RootMotionTool, KeepsTheSwingOfAWalk) {
    const json report = make("x", {});
    EXPECT_NEAR(report["bake"]["root_motion"]["distance"].get<double>(), 40.0, 0.5);
    EXPECT_EQ(report["bake"]["root_motion"]["angle_deg"], 0.0);
    const json of_file = parse_object(info({path("x.paim"), "--json"}));
    EXPECT_EQ(of_file["root_motion"], report["bake"]["root_motion"]);
    EXPECT_EQ(parse_object(info({path("x.bake"), "--json"}))["root_motion"],
              of_file["root_motion"]);
    // Vertices come in the order of the bake, and so of the OBJ.
    Playback playback(std::make_shared<const Asset>(read_paim(path("x.paim"))));
    const int top = (kRings - 1) * kSegments;
    for (int p = 0; p < kPoses; ++p) {
        playback.update(p);
        const auto planes = playback.positions();
        const auto num_vertices = static_cast<int>(planes.size() / 3);
        EXPECT_NEAR(planes[static_cast<size_t>(top)], 5.0 * p, 1e-3) << p;
        EXPECT_NEAR(planes[static_cast<size_t>(2 * num_vertices + top)], 0.2 + swing(p, 2.0), 1e-3)
            << p;
    }
    expect_success(analyze({path("x.bake"), "--verify", path("x.paim")}));
}

// An outlier neither bends the path nor hides the swing, and is named where it is in the scene.
TEST_F(RootMotionTool, SeesPastAnOutlier) {
    write_walk("bad", 4);
    const json report = make("bad", {}, "bad");
    EXPECT_NEAR(report["bake"]["root_motion"]["distance"].get<double>(), 40.0, 0.5);
    EXPECT_LT(report["encode"]["measured"]["position_relative_rms"].get<double>(), 1e-3);
    const ToolResult encoded =
        compress({"encode", path("bad.bake"), "-o", path("bad5.paim"), "--max-error", "20%"});
    expect_success(encoded);
    EXPECT_TRUE(contains(encoded.err, "(5000, 4000, ")) << encoded.err;
    expect_success(analyze({path("bad.bake"), "--verify", path("bad5.paim")}));
}

// The body travels, and the floor does not: all that has a face is where it was.
TEST_F(RootMotionTool, LeavesAFloorInItsPlace) {
    const Arguments floor{"--floor", "--floor-vertices", "300"};
    const json report = make("x", floor);
    EXPECT_NEAR(report["bake"]["root_motion"]["distance"].get<double>(), 40.0, 0.5);
    expect_success(
        compress({"encode", path("x.bake"), "-o", path("t.paim"), "--max-error", "20%"}));
    for (const char* const file : {"x.paim", "t.paim"}) {
        SCOPED_TRACE(file);
        expect_success(analyze({path("x.bake"), "--verify", path(file)}));
        const auto asset = std::make_shared<const Asset>(read_paim(path(file)));
        const uint32_t num_following = asset->moving().num_following;
        EXPECT_EQ(num_following, uint32_t{kRings * kSegments});
        Playback playback(asset);
        for (int p = 0; p < kPoses; ++p) {
            playback.update(p);
            const auto planes = playback.positions();
            const size_t num_vertices = planes.size() / 3;
            Bounds body, ground;
            for (size_t v = 0; v < num_vertices; ++v) {
                (v < num_following ? body : ground)
                    .extend(
                        Vec3f(planes[v], planes[num_vertices + v], planes[2 * num_vertices + v]));
            }
            EXPECT_NEAR(body.center().x(), 5.0 * p, 0.05) << p;
            EXPECT_NEAR(ground.lower.y(), ground.upper.y(), 1e-6) << p;
            EXPECT_NEAR(ground.upper.y(), 0.0, 0.1) << p;
            // 40 units of path, and 0.3 of this beyond each end.
            EXPECT_NEAR(ground.lower.x(), -12.4, 0.5) << p;
            EXPECT_NEAR(ground.upper.x(), 52.4, 0.5) << p;
        }
    }
}

// A path hides no outlier from the floor.
TEST_F(RootMotionTool, LeavesAnOutlierBelowTheFloorOfAWalk) {
    write_walk("low", 4, 0.0, "v 20 -60 0\n");
    const Arguments floor{"--floor", "--floor-vertices", "100"};
    EXPECT_EQ(make("low", floor, "low")["bake"]["floor"], make("clean", floor)["bake"]["floor"]);
}

// Errors are relative to the diagonal of the body, wherever it is in the scene and however far it goes.
// Without a root motion they are relative to that of body and floor.
TEST_F(RootMotionTool, MeasuresABodyOnAFloorByItself) {
    write_walk("away", -1, 300.0);
    const auto diagonal = [&](const std::string& choice) {
        const json report =
            make(choice, {"--floor", "--floor-vertices", "300", "--root-motion", choice}, "away");
        const json measured = report["encode"]["measured"];
        return measured["position_rms"].get<double>() /
               measured["position_relative_rms"].get<double>();
    };
    // 0.4 wide, 2 tall, and swung by up to 0.3.
    EXPECT_NEAR(diagonal("translation"), 2.11, 0.05);
    // The floor's: 65 units along x, 25 along z.
    EXPECT_NEAR(diagonal("none"), 70.0, 5.0);
}

TEST_F(RootMotionTool, LeavesPosesAsTheyAreIfAsked) {
    const json none = make("none", {"--root-motion", "none"});
    EXPECT_FALSE(none["bake"].contains("root_motion"));
    EXPECT_TRUE(make("rigid", {"--root-motion", "rigid"})["bake"].contains("root_motion"));
    // Files of one are not those of the other.
    const ToolResult other = analyze({path("none.bake"), "--verify", path("rigid.paim")});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_TRUE(contains(other.err, "another root motion")) << other.err;
}

// Each of a crowd walks its own way; no root motion goes with all of them.
TEST_F(RootMotionTool, KeepsTheSwingOfACrowd) {
    constexpr int kWalkers = 24;
    std::filesystem::create_directory(directory_ / "crowd");
    const auto place = [](int walker, int ring, int segment, int p) {
        const double way = 2.0 * kPi * walker / kWalkers, angle = 2.0 * kPi * segment / kSegments;
        const double y = 0.25 * ring, walked = 10.0 + 5.0 * p;
        return Vec3d(walked * std::sin(way) + 0.2 * std::sin(angle), y,
                     walked * std::cos(way) + 0.2 * std::cos(angle) + swing(p, y));
    };
    for (int p = 0; p < kPoses; ++p) {
        std::string vertices, faces;
        for (int walker = 0; walker < kWalkers; ++walker) {
            const int first = 1 + walker * kRings * kSegments;
            for (int ring = 0; ring < kRings; ++ring) {
                for (int segment = 0; segment < kSegments; ++segment) {
                    const Vec3d x = place(walker, ring, segment, p);
                    vertices += fmt::format("v {:.6f} {:.6f} {:.6f}\n", x.x(), x.y(), x.z());
                    if (ring + 1 == kRings) continue;
                    const int a = first + ring * kSegments + segment;
                    const int b = first + ring * kSegments + (segment + 1) % kSegments;
                    faces += fmt::format("f {} {} {} {}\n", a, b, b + kSegments, a + kSegments);
                }
            }
        }
        write(fmt::format("crowd/{}.obj", p), vertices + faces);
    }
    make("crowd", {}, "crowd");
    Playback playback(std::make_shared<const Asset>(read_paim(path("crowd.paim"))));
    for (int p = 0; p < kPoses; ++p) {
        playback.update(p);
        const auto planes = playback.positions();
        const size_t num_vertices = planes.size() / 3;
        for (int walker = 0; walker < kWalkers; ++walker) {
            const auto top = static_cast<size_t>(((walker + 1) * kRings - 1) * kSegments);
            const Vec3d x = place(walker, kRings - 1, 0, p);
            // A tenth of the swing of 0.3 may be lost.
            EXPECT_NEAR(planes[2 * num_vertices + top], x.z(), 0.06) << p << ' ' << walker;
        }
    }
}

// A bake of another motion is another bake.
TEST_F(RootMotionTool, IsPartOfTheIdentityOfABake) {
    const auto bake = [&](const std::string& choice) {
        return compress(
            {"bake", path("walk"), "-o", path("x.bake"), "--rays", "2", "--root-motion", choice});
    };
    expect_success(bake("none"));
    const ToolResult again = bake("translation");
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_TRUE(contains(again.err, "root motion: none there")) << again.err;
}

}  // namespace
}  // namespace paim
