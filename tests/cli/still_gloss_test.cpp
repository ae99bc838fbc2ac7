// Gloss of still meshes through the tools: among poses that are matte, and by itself.
#include <algorithm>
#include <cmath>
#include <memory>

#include "paim/codec/playback.h"
#include "paim/format/paim/paim_read.h"
#include "tests/cli/gloss_tool.h"
#include "tests/random_light.h"

namespace paim {
namespace {

using nlohmann::json;

constexpr const char* kKeeps =
    "with --material phong:0,1, which makes the poses glossy and reflects nothing";

class StillGloss : public GlossTool {
  protected:
    // Poses of a sphere of radius 1 at the origin, next to a shiny one.
    void SetUp() override {
        GlossTool::SetUp();
        write_shiny_sphere("shiny", Vec3d(0.5, 0.25, 3.0));
    }

    ToolResult bake_scene(const std::string& name, const Arguments& more = {}) const {
        Arguments options{"--static", path("shiny.obj"), "--gloss", "--gloss-bands", "3,2"};
        options.insert(options.end(), more.begin(), more.end());
        return bake(name, options);
    }

    // Outgoing coefficients of the first pose of a file, in some light.
    std::vector<Vec3f> exit_radiance(const std::string& file, size_t part) const {
        Playback playback(std::make_shared<const Asset>(read_paim(path(file))));
        playback.keep_exit_radiance(true);
        playback.set_light(DistantLight(random_light(3, 5)));
        playback.update(0.0);
        const std::span<const Vec3f> exit = playback.exit_radiance(part);
        return {exit.begin(), exit.end()};
    }
};

double largest(const std::vector<Vec3f>& values) {
    double most = 0.0;
    for (const Vec3f& value : values) most = std::max(most, double{value.cwiseAbs().maxCoeff()});
    return most;
}

double largest_difference(std::vector<Vec3f> a, const std::vector<Vec3f>& b) {
    EXPECT_EQ(a.size(), b.size());
    for (size_t j = 0; j < std::min(a.size(), b.size()); ++j) a[j] -= b[j];
    return largest(a);
}

TEST_F(StillGloss, AmongMattePosesIsNotEncodedAndNotesSayHowToKeepIt) {
    const ToolResult baked = bake_scene("s.bake");
    expect_success(baked);
    EXPECT_TRUE(
        contains(baked.err, std::string("note: gloss: no vertex of the poses is glossy, and "
                                        "the gloss of still meshes alone is not encoded: it "
                                        "is kept ") +
                                kKeeps + "\n"))
        << baked.err;
    EXPECT_FALSE(contains(baked.err, " on disk for ")) << baked.err;
    const auto encode_quietly = [&](const std::string& from, const Arguments& more = {}) {
        Arguments arguments{"encode",      path(from), "-o",     path("x.paim"),
                            "--max-error", "10%",      "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return compress(arguments);
    };
    const ToolResult encoded = encode_quietly("s.bake", {"--max-gloss-error", "5%"});
    expect_success(encoded);
    EXPECT_TRUE(
        contains(encoded.err, std::string("note: no vertex of the poses is glossy, and the "
                                          "gloss of still meshes alone is not encoded (bake "
                                          "again ") +
                                  kKeeps + ", into another .bake)\n"))
        << encoded.err;
    EXPECT_TRUE(contains(encoded.err,
                         "note: --max-gloss-error is not used: no vertex of the poses "
                         "is glossy\n"))
        << encoded.err;
    const std::string without = text_of("x.paim");
    EXPECT_FALSE(read_paim(path("x.paim")).still()->gloss.has_value());
    expect_success(analyze({path("s.bake"), "--verify", path("x.paim")}));

    // The rest of the file is that of a bake without gloss, of which nothing is said.
    expect_success(bake("d.bake", {"--static", path("shiny.obj")}));
    const ToolResult diffuse = encode_quietly("d.bake");
    expect_success(diffuse);
    EXPECT_FALSE(contains(diffuse.err, "gloss")) << diffuse.err;
    EXPECT_TRUE(text_of("x.paim") == without);
}

// What the notes say.
TEST_F(StillGloss, IsKeptWhereThePosesAreGlossyAndReflectNothing) {
    expect_success(bake_scene("k.bake", {"--material", "phong:0,1"}));
    const json report = encode("k.bake", "k.paim", {"--max-error", "5%"});
    expect_success(analyze({path("k.bake"), "--verify", path("k.paim")}));
    EXPECT_EQ(largest(exit_radiance("k.paim", 0)), 0.0);
    EXPECT_GT(largest(exit_radiance("k.paim", 1)), 0.1);
    EXPECT_LE(report["gloss"]["measured"]["scenery_transfer_total_error"].get<double>(), 0.05);
}

// Still meshes are baked without the poses and their floor. A convex one blocks no light of its own, so
// that its transfer has no noise, and is the same from any rays.
TEST_F(StillGloss, IsThatOfTheMeshAlone) {
    const Arguments scene{"--material", "phong:0.5,4",      "--bounces", "1",
                          "--floor",    "--floor-vertices", "100"};
    expect_success(bake_scene("g.bake", scene));
    encode("g.bake", "g.paim");
    expect_success(compress({"bake", path("shiny.obj"), "-o", path("alone.bake"), "--rays", "32",
                             "--bands", "3", "--gloss", "--gloss-bands", "3,2", "--quiet"}));
    encode("alone.bake", "alone.paim");
    const std::vector<Vec3f> alone = exit_radiance("alone.paim", 0);
    EXPECT_GT(largest(alone), 0.1);
    // Files without a target have all components, as floats. Sums of 9 products below 1.
    EXPECT_LT(largest_difference(exit_radiance("g.paim", 1), alone), 3e-6);

    // Another mesh in its light shows that the two could differ.
    write_shiny_sphere("near", Vec3d(0.5, 0.25, 5.2));
    Arguments shadowed = scene;
    for (const std::string& word : {std::string("--static"), path("near.obj")}) {
        shadowed.push_back(word);
    }
    expect_success(bake_scene("n.bake", shadowed));
    encode("n.bake", "n.paim");
    std::vector<Vec3f> first = exit_radiance("n.paim", 1);
    EXPECT_EQ(first.size(), 2 * alone.size());
    // The rows of the first mesh come first, of each coefficient.
    const size_t num_rows = alone.size() / 4;
    std::vector<Vec3f> of_mesh;
    for (size_t o = 0; o < 4; ++o) {
        const auto begin = first.begin() + static_cast<ptrdiff_t>(2 * o * num_rows);
        of_mesh.insert(of_mesh.end(), begin, begin + static_cast<ptrdiff_t>(num_rows));
    }
    EXPECT_GT(largest_difference(of_mesh, alone), 0.02);
}

}  // namespace
}  // namespace paim
