// Pictures of gloss: the stage draws what Playback plays.
#include "analysis/stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/encode.h"
#include "compressor/encode/search/glossy_encode.h"
#include "paim/codec/playback.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/format/paim/paim_read.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/unit_scale.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/random_light.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

constexpr uint32_t kStagePoses = 2;
constexpr int kGlossBands = 3;

// An octopus of which half is glossy, in two tints.
class HalfGlossy : public PoseSet {
  public:
    explicit HalfGlossy(const PoseSet& octopus)
        : PoseSet(octopus.topology(),
                  {octopus.load_pose(0).positions, octopus.load_pose(1).positions}) {
        materials_.glossy = {{"phong:0.5,4", Vec3f::Ones()}, {"phong:0.9,8", Vec3f(1, 0.5f, 0.2f)}};
        materials_.of_vertex.clear();
        for (uint32_t v = 0; v < topology().num_vertices; ++v) {
            materials_.of_vertex.push_back(
                2 * v < topology().num_vertices ? static_cast<uint16_t>(1 + v % 2) : uint16_t{0});
        }
    }
    const Materials& materials() const override { return materials_; }

  private:
    Materials materials_;
};

// Next to the octopus.
Surroundings shiny_sphere() {
    const PoseSet sphere = poses::make_pose_set(*poses::make_sphere_sequence(100), 1);
    std::vector<Vec3f> positions = sphere.load_pose(0).positions;
    for (Vec3f& x : positions) x += Vec3f(3.0f, 1.0f, 3.0f);
    Surroundings around;
    around.still_mesh.add(PoseSet(sphere.topology(), {positions}));
    around.still_mesh.materials = {{{"phong:0.7,5", Vec3f(0.3f, 1, 1)}}, {1}};
    return around;
}

// It changes the axes that poses are coded in. Any motion will do whose numbers a bake keeps, as it keeps
// multiples of kRotationUnit_rad.
RootMotion some_motion() {
    RootMotion motion(kStagePoses);
    for (size_t p = 0; p < motion.size(); ++p) {
        motion[p].rotation = rotation_of(Vec3d(0.25, 0.875 + 0.5 * static_cast<double>(p), -0.375));
        motion[p].translation = Vec3d(0.5, -0.25, 1.0 + static_cast<double>(p));
    }
    return motion;
}

class GlossStage : public testing::Test {
  protected:
    BakeReader bake() const {
        BakeOptions options;
        options.bands = 2;
        options.rays = 16;
        options.gloss_in_bands = kGlossBands;
        options.gloss_out_bands = 3;
        const HalfGlossy octopus(poses::make_octopus(1000, kStagePoses));
        bake_sequence(
            octopus, options, "faces", directory_ / "x.bake", 0, kStagePoses - 1, [](uint32_t) {},
            shiny_sphere(), some_motion());
        return BakeReader(directory_ / "x.bake");
    }

    // All of the bake, as floats.
    Playback play(const BakeReader& bake) const {
        EncodeOptions options;
        options.geometry.kind = options.transfer.kind = ComponentChoice::Kind::all;
        const TransferFiles files{directory_ / "diffuse.paim", directory_ / "gloss.paim"};
        encode(bake, options, files.diffuse);
        encode(bake.gloss(), options, files.gloss);
        const BandPower flat = BandPower::flat(bake.gloss().identity().layout.in_bands);
        join_transfer_files(bake, files, flat, directory_ / "x.paim");
        return Playback(std::make_shared<const Asset>(read_paim(directory_ / "x.paim")));
    }

    const TemporaryDirectory directory_;
};

// Positions of the rows of gloss at the last update, scaled. [R]
std::vector<Vec3f> row_positions(const Playback& playback, size_t part, float scale) {
    const std::vector<Vec3f> all = from_planes(playback.positions(part));
    const CodedGloss& gloss = *playback.asset().parts[part].gloss;
    std::vector<Vec3f> rows;
    for (uint32_t r = 0; r < gloss.num_rows; ++r) rows.emplace_back(scale * all[gloss.vertex(r)]);
    return rows;
}

Bounds bounds_of(const std::vector<Vec3f>& positions) {
    Bounds bounds;
    for (const Vec3f& x : positions) bounds.extend(x);
    return bounds;
}

// The cameras that the stage says it has, of a scene that is scaled.
struct Cameras {
    Cameras(Playback& playback, const StageOptions& options) {
        Bounds poses;
        for (uint32_t p = 0; p < kStagePoses; ++p) {
            playback.update(p);
            const Bounds of_pose = bounds_of(row_positions(playback, 0, 1.0f));
            poses.extend(of_pose.lower);
            poses.extend(of_pose.upper);
        }
        scale = unit_scale(static_cast<double>(
            std::max(poses.lower.cwiseAbs().maxCoeff(), poses.upper.cwiseAbs().maxCoeff())));
        poses.lower *= scale;
        poses.upper *= scale;
        const Bounds all = framed_bounds(poses, bounds_of(row_positions(playback, 1, scale)));
        for (uint32_t view = 0; view < options.num_views; ++view) {
            const double azimuth = options.azimuth_rad + 2.0 * kPi * view / options.num_views;
            of_views.push_back(frame_bounds(all, 1.0f, static_cast<float>(azimuth),
                                            static_cast<float>(options.elevation_rad)));
        }
    }

    float scale = 1.0f;
    std::vector<Camera> of_views;
};

TEST_F(GlossStage, DrawsWhatPlaybackPlays) {
    const BakeReader whole = bake();
    const BakeReader gloss = whole.gloss();
    ASSERT_LT(gloss.identity().num_vertices, whole.identity().num_vertices);
    ASSERT_TRUE(gloss.still_mesh().has_value());
    StageOptions options;
    options.num_views = 3;
    options.size_pixels = 64;
    options.elevation_rad = 0.3;
    std::vector<NamedLight> lights = load_lights({}, EnvMapping::automatic, kGlossBands);
    lights.front().coefficients = random_light(kGlossBands, 6);
    const Stage stage(gloss, lights, options);
    Playback playback = play(whole);
    playback.set_light(DistantLight(lights.front().coefficients));
    const Cameras cameras(playback, options);
    for (uint32_t p = 0; p < kStagePoses; ++p) {
        const DecodedPose pose = baked_pose(gloss, p, gloss.read_pose(p));
        const std::vector<Image> drawn = stage.render_pose(pose);
        const std::vector<VisiblePoints> visible = stage.look(stage.place(pose));
        ASSERT_EQ(drawn.size(), 3u);
        for (size_t view = 0; view < drawn.size(); ++view) {
            playback.set_eye(Vec3f(cameras.of_views[view].eye / cameras.scale));
            playback.update(p);
            std::vector<Vec3f> radiance;
            for (size_t part = 0; part < 2; ++part) {
                const std::span<const Vec3f> rows = playback.gloss_radiance(part);
                radiance.insert(radiance.end(), rows.begin(), rows.end());
            }
            const Image played = stage.draw(visible, {radiance})[view];
            double largest = 0.0, difference = 0.0;
            for (size_t j = 0; j < played.pixels.size(); ++j) {
                const Vec3f& pixel = played.pixels[j];
                largest = std::max(largest, double{pixel.cwiseAbs().maxCoeff()});
                difference = std::max(
                    difference, double{(drawn[view].pixels[j] - pixel).cwiseAbs().maxCoeff()});
            }
            // Positions and transfer are sums of a mean and a component in floats, and directions of
            // 1e-7 and coefficients of 2 make sums of 9 products of 9 products.
            EXPECT_LT(difference, 1e-5) << p << ' ' << view;
            EXPECT_GT(largest, 0.1) << p << ' ' << view;
        }
    }
}

}  // namespace
}  // namespace paim
