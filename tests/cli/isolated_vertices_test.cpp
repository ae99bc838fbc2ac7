// Vertices of no face count for nothing on the whole road: files made with them are as good as files
// made without them, and have the same components and steps.
#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "paim/codec/sequence_bounds.h"
#include "paim/format/paim/paim_read.h"
#include "tests/cli/tool_test.h"

namespace paim {
namespace {

using nlohmann::json;

// The position of a vertex of no face in a pose, as text.
using Isolated = std::function<std::string(int pose)>;

class IsolatedVertices : public ToolTest {
  protected:
    // So many vertices that what rounding happens to do to one is no matter.
    static constexpr int kPoses = 6, kRings = 11, kSegments = 24;

    // A tube 2 units tall at x = 3 that bends and breathes, as OBJ files in this folder.
    // before, after  vertices of no face, in front of those of the tube and behind them
    std::string write_tube(const std::string& folder, const std::vector<Isolated>& before,
                           const std::vector<Isolated>& after) const {
        std::filesystem::create_directory(directory_ / folder);
        for (int p = 0; p < kPoses; ++p) {
            std::string text;
            for (const Isolated& position : before) text += "v " + position(p) + "\n";
            const double time = 2.0 * kPi * p / kPoses;
            for (int ring = 0; ring < kRings; ++ring) {
                const double y = 0.2 * ring;
                for (int segment = 0; segment < kSegments; ++segment) {
                    const double angle = 2.0 * kPi * segment / kSegments;
                    const double radius = 0.2 + 0.05 * std::sin(time + 3.0 * y);
                    text +=
                        fmt::format("v {:.6f} {:.6f} {:.6f}\n",
                                    3.0 + radius * std::sin(angle) + 0.1 * y * y * std::sin(time),
                                    y, radius * std::cos(angle) + 0.05 * y * std::cos(2.0 * time));
                }
            }
            for (const Isolated& position : after) text += "v " + position(p) + "\n";
            const size_t first = before.size() + 1;
            for (int ring = 0; ring + 1 < kRings; ++ring) {
                for (int segment = 0; segment < kSegments; ++segment) {
                    const auto number = [&](int r, int s) {
                        return first + static_cast<size_t>(r * kSegments + s % kSegments);
                    };
                    text += fmt::format("f {} {} {} {}\n", number(ring, segment),
                                        number(ring, segment + 1), number(ring + 1, segment + 1),
                                        number(ring + 1, segment));
                }
            }
            write(fmt::format("{}/{}.obj", folder, p), text);
        }
        return path(folder);
    }

    struct Made {
        json report;
        Asset asset;
    };

    // The tube of this folder as a file. Random numbers differ from vertex number to vertex number,
    // so that transfer is compared within its noise.
    Made make(const std::string& folder, const Arguments& bake_options,
              const Arguments& encode_options) {
        const std::string bake = path(folder + ".bake"), file = path(folder + ".paim");
        Arguments arguments{"bake", path(folder), "-o", bake, "--rays", "64", "--bands", "3"};
        arguments.insert(arguments.end(), bake_options.begin(), bake_options.end());
        expect_success(compress(arguments));
        arguments = {"encode", bake, "-o", file, "--json"};
        arguments.insert(arguments.end(), encode_options.begin(), encode_options.end());
        Made made{parse_object(compress(arguments)), read_paim(file)};
        EXPECT_EQ(analyze({bake, "--verify", file}).exit_code, 0);
        expect_success(info({file}));
        return made;
    }

    static void expect_same_geometry(const Made& expected, const Made& made, size_t num_isolated,
                                     const std::string& what) {
        const LowRank& positions = made.asset.moving().positions;
        const LowRank& reference = expected.asset.moving().positions;
        EXPECT_EQ(positions.num_points, reference.num_points + num_isolated) << what;
        EXPECT_EQ(positions.num_components, reference.num_components) << what;
        ASSERT_EQ(positions.singular_values.size(), reference.singular_values.size()) << what;
        for (size_t k = 0; k < reference.singular_values.size(); ++k) {
            // Sums over rows have another order.
            EXPECT_NEAR(positions.singular_values[k], reference.singular_values[k],
                        1e-9 * reference.singular_values[0])
                << what;
        }
        for (size_t axis = 0; axis < reference.steps.size(); ++axis) {
            EXPECT_NEAR(positions.steps[axis] / reference.steps[axis], 1.0, 0.02) << what;
        }
        const Bounds bounds = sequence_bounds(made.asset);
        const Bounds expected_bounds = sequence_bounds(expected.asset);
        EXPECT_LT((bounds.lower - expected_bounds.lower).cwiseAbs().maxCoeff(), 0.02f) << what;
        EXPECT_LT((bounds.upper - expected_bounds.upper).cwiseAbs().maxCoeff(), 0.02f) << what;
        for (const char* const name :
             {"position_rms", "position_relative_rms", "kg_error", "e_rms"}) {
            const double value = made.report["measured"][name];
            const double without = expected.report["measured"][name];
            EXPECT_NEAR(value / without, 1.0, 0.05) << what << ": " << name;
        }
        // One value, which depends on how it was rounded.
        const double worst = made.report["measured"]["position_worst"];
        EXPECT_LT(worst, 1.5 * expected.report["measured"]["position_worst"].get<double>()) << what;
    }

    static std::vector<Isolated> many(size_t count) {
        std::vector<Isolated> vertices;
        for (size_t j = 0; j < count; ++j) {
            vertices.push_back([j](int p) {
                return fmt::format("{} {} {}", 0.01 * static_cast<double>(j) - 9.0 * p, 7 + p, -40);
            });
        }
        return vertices;
    }

    struct Kind {
        std::string name;
        std::vector<Isolated> before, after;
    };

    static std::vector<Kind> kinds() {
        const auto at = [](std::string text) { return [text](int) { return text; }; };
        const Isolated moving = [](int p) { return fmt::format("{} 50 {}", -20 * p, p * p); };
        return {{"still", {at("0 0 40")}, {}},
                {"moving", {moving}, {}},
                {"many", many(300), many(200)},
                {"huge", {at("1e30 -1e30 5")}, {at("0 3.3e38 0")}},
                {"once", {}, {[](int p) { return p == 2 ? "900 -900 0" : "3 1 0"; }}}};
    }
};

TEST_F(IsolatedVertices, ChangeNothingOfFilesOfATarget) {
    const Arguments target{"--max-error", "5%"};
    write_tube("plain", {}, {});
    const Made expected = make("plain", {}, target);
    for (const Kind& kind : kinds()) {
        write_tube(kind.name, kind.before, kind.after);
        const Made made = make(kind.name, {}, target);
        expect_same_geometry(expected, made, kind.before.size() + kind.after.size(), kind.name);
        // The diagonal is that of the tube.
        EXPECT_NEAR(made.report["geometry_target"].get<double>(),
                    expected.report["geometry_target"].get<double>(), 1e-9)
            << kind.name;
    }
}

TEST_F(IsolatedVertices, ChangeNothingOfFilesOfComponents) {
    write_tube("plain", {}, {});
    const Made expected = make("plain", {}, {"--measure"});
    EXPECT_GE(expected.asset.moving().positions.num_components, 2u);
    for (const Kind& kind : kinds()) {
        write_tube(kind.name, kind.before, kind.after);
        const Made made = make(kind.name, {}, {"--measure"});
        expect_same_geometry(expected, made, kind.before.size() + kind.after.size(), kind.name);
        EXPECT_EQ(made.report["transfer"]["components"], expected.report["transfer"]["components"])
            << kind.name;
    }
}

// The floor is as large as without them; still meshes have some of their own.
TEST_F(IsolatedVertices, ChangeNothingOfFloorsAndStillMeshes) {
    const Arguments target{"--max-error", "8%"};
    write_tube("plain", {}, {});
    write_tube("wall", {}, {});
    const Arguments floor{"--floor", "--floor-vertices", "100", "--static", path("wall/0.obj")};
    const Made expected = make("plain", floor, target);
    const Kind kind = kinds()[1];
    write_tube("stray", kind.before, kind.after);
    write_tube("stray_wall", kinds()[3].before, kinds()[3].after);
    Arguments stray_floor = floor;
    stray_floor.back() = path("stray_wall/0.obj");
    const Made made = make("stray", stray_floor, target);
    expect_same_geometry(expected, made, kind.before.size() + kind.after.size(), "stray");
    const double value = made.report["measured"]["scenery_position_rms"];
    EXPECT_NEAR(value / expected.report["measured"]["scenery_position_rms"].get<double>(), 1.0,
                0.2);
    EXPECT_LT(sequence_bounds(made.asset).diagonal(),
              1.01f * sequence_bounds(expected.asset).diagonal());
}

// What paim-analyze measures and draws.
TEST_F(IsolatedVertices, ChangeNothingOfCurves) {
    const auto curves = [&](const std::string& name) {
        expect_success(compress(
            {"bake", path(name), "-o", path(name + ".bake"), "--rays", "64", "--bands", "2"}));
        return parse_object(analyze({path(name + ".bake"), "-o", path(name + ".report"), "--size",
                                     "32", "--components", "1", "--bands", "1", "--json"}));
    };
    write_tube("plain", {}, {});
    write_tube("many", many(300), many(200));
    const json expected = curves("plain")["geometry_components"];
    const json found = curves("many")["geometry_components"];
    ASSERT_EQ(found.size(), expected.size());
    for (size_t j = 0; j < expected.size(); ++j) {
        if (expected[j]["position_rms"].get<double>() < 1e-4) continue;  // all components: rounding
        EXPECT_NEAR(found[j]["position_rms"].get<double>(),
                    expected[j]["position_rms"].get<double>(), 1e-6);
        EXPECT_EQ(found[j]["position_worst"]["vertex"].get<int>(),
                  expected[j]["position_worst"]["vertex"].get<int>() + 300);
        EXPECT_NEAR(found[j]["visual_error"]["sky"].get<double>(),
                    expected[j]["visual_error"]["sky"].get<double>(), 0.02);
    }
}

}  // namespace
}  // namespace paim
