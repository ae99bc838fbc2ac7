// Pictures of the player against the CPU renderer: codecs, decoders, cameras, lights, colours and crowds.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/search/target_encode.h"
#include "compressor/scene/floor.h"
#include "compressor/scene/root_motion.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/image/tone.h"
#include "paim/light/sky.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/planes.h"
#include "paim/metrics/image_error.h"
#include "paim/render/render.h"
#include "player/gl/headless_context.h"
#include "player/inspect/false_color.h"
#include "player/presenter.h"
#include "player/read_asset.h"
#include "player/view/crowd.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/player/test_asset.h"
#include "tests/player/two_lamps.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

constexpr int kPictureWidth = 240, kPictureHeight = 180;
constexpr int kCrowdWidth = 320, kCrowdHeight = 240;  // copies are small
constexpr float kPictureAspect = float{kPictureWidth} / kPictureHeight;
constexpr uint32_t kBands = 4, kNumPoses = 4;

const std::vector<std::string> kCodecs{"svd", "cpca"};
const std::vector<Decoder> kDecoders{Decoder::gpu, Decoder::cpu};

// One sequence, baked with few rays, in both codecs.
struct Sequence {
    std::string name;
    std::vector<std::shared_ptr<const Asset>> assets;  // of kCodecs
};

Sequence compress(const std::string& name, const PoseSource& poses,
                  const Surroundings& surroundings, const RootMotion& root_motion) {
    const TemporaryDirectory directory;
    BakeOptions options{kBands, 32, 1};
    bake_sequence(
        poses, options, "faces", directory / "x.bake", 0, kNumPoses - 1, [](uint32_t) {},
        surroundings, root_motion);
    const BakeReader bake(directory / "x.bake");
    Sequence coded{name, {}};
    for (const std::string& codec : kCodecs) {
        EncodeOptions encode_options;
        encode_options.precision = Precision::i16;
        EncodeTarget target;
        target.transfer_error = 0.4;
        target.codec = codec;
        target.spectrum = BandPower::flat(kBands);
        encode_to_target(bake, encode_options, target, directory / "x.paim");
        coded.assets.push_back(read_asset(directory / "x.paim"));
        EXPECT_EQ(coded.assets.back()->moving().transfer->codec_name(), codec);
    }
    return coded;
}

Sequence octopus() {
    return compress("octopus", poses::make_octopus(1000, kNumPoses), {}, {});
}

// The octopus walks and turns.
Sequence walking() {
    const PoseSet still = poses::make_octopus(1000, kNumPoses);
    std::vector<std::vector<Vec3f>> positions(kNumPoses);
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        const RigidTransform place{Eigen::Quaterniond(Eigen::AngleAxisd(0.8 * p, Vec3d::UnitY())),
                                   Vec3d(2.0 * p, 0.2 * p, -1.5 * p)};
        for (const Vec3f& x : still.load_pose(p).positions) {
            positions[p].push_back(place.to_scene(x.cast<double>()).cast<float>());
        }
    }
    const PoseSet poses(still.topology(), positions, still.albedo());
    return compress("walking", poses, {}, find_root_motion(poses, RootMotionChoice::rigid));
}

// A box that turns over a floor, which does not follow it, with a still sphere next to it.
Sequence furnished() {
    const PoseSet box = poses::make_pose_set(*poses::make_box_sequence(200), kNumPoses);
    const RootMotion root_motion =
        find_root_motion(box, RootMotionChoice::rigid, {}, LocalOrigin::reference);
    FloorOptions options;
    options.num_vertices = 400;
    const PosesOnFloor poses(box, bounds_of(box, {}, root_motion), options);
    const PoseSet sphere = poses::make_pose_set(*poses::make_sphere_sequence(300), 1);
    std::vector<Vec3f> positions = sphere.load_pose(0).positions;
    for (Vec3f& x : positions) x = 0.4f * x + Vec3f(1.9f, -0.5f, 0.75f);
    Surroundings surroundings;
    surroundings.floor = poses.description();
    surroundings.still_mesh.add(PoseSet(sphere.topology(), {positions}, sphere.albedo()));
    return compress("furnished", poses, surroundings, root_motion);
}

constexpr size_t kNumSequences = 3;

// Made when a test first asks for it.
const Sequence& sequence(size_t number) {
    static std::array<std::optional<Sequence>, kNumSequences> made;
    const std::array makers{octopus, walking, furnished};
    if (!made[number]) made[number] = makers[number]();
    return *made[number];
}

// What each vertex of a part shows at a time.
using VertexColors = std::function<std::vector<Vec3f>(size_t part, double time)>;

// The CPU renderer's picture of some copies, all parts of each, over a colour.
Image render_reference(const Asset& asset, const Camera& camera, double time,
                       const DecodeLimits& limits, const std::vector<Instance>& copies,
                       const VertexColors& colors, const Vec3f& background,
                       int width = kPictureWidth, int height = kPictureHeight) {
    Topology topology;
    std::vector<Vec3f> positions, shown;
    for (const Instance& copy : copies) {
        const double own_time =
            std::fmod(time + copy.time_offset, static_cast<double>(asset.num_poses()));
        // What stands still is there once.
        const size_t num_parts = &copy == &copies.front() ? asset.parts.size() : 1;
        for (size_t j = 0; j < num_parts; ++j) {
            const CodedMesh& mesh = asset.parts[j];
            DecodedPose pose;
            MeshDecoder(mesh).decode(own_time, limits, pose);
            move_to_scene(pose.root, pose.positions, pose.num_following);
            for (const Vec3f& x : from_planes(pose.positions)) {
                positions.push_back(x + copy.offset.cast<float>());
            }
            const std::vector<Vec3f> of_part = colors(j, own_time);
            shown.insert(shown.end(), of_part.begin(), of_part.end());
            topology.append(mesh.topology);
        }
    }
    const VisiblePoints visible = find_visible(topology, positions, camera, width, height);
    Image image = interpolate_image(visible, topology, shown);
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        if (visible.hits[i].triangle == kNoTriangle) image.pixels[i] = background;
    }
    return image;
}

// Pixels at edges may show either side of the edge. Elsewhere both pictures agree to two steps of
// eight bits.
void expect_same(const Image& expected, Image drawn, const Vec3f& background,
                 const std::string& what) {
    const ToneCurve curve;
    size_t covered = 0, off = 0;
    Image without = expected;
    for (size_t j = 0; j < expected.pixels.size(); ++j) {
        if (expected.pixels[j] == background && drawn.pixels[j] == background) {
            without.pixels[j] = drawn.pixels[j] = Vec3f::Zero();
            continue;
        }
        ++covered;
        int largest = 0;
        for (int channel = 0; channel < 3; ++channel) {
            largest = std::max(largest, std::abs(curve.apply(expected.pixels[j][channel]) -
                                                 curve.apply(drawn.pixels[j][channel])));
        }
        off += largest > 2 ? 1 : 0;
    }
    EXPECT_GT(covered, expected.pixels.size() / 40) << what;
    EXPECT_LE(compare_images(drawn, without).visual_error(), 1e-3) << what;
    EXPECT_LE(static_cast<double>(off), 5e-3 * static_cast<double>(covered)) << what;
}

class PresentedPictures : public testing::Test {
  protected:
    Presenter make(const Sequence& shown, size_t codec, Decoder decoder,
                   const Image& environment) const {
        const auto& asset = shown.assets[codec];
        return {asset, sequence_bounds(*asset), EnvironmentLight(environment), {}, {}, decoder};
    }

    static ViewState black_view(double time) {
        ViewState view;
        view.animation.time = time;
        view.background.kind = Background::Kind::color;
        return view;
    }

    // Calls check(presenter, what) for every sequence, codec and decoder.
    void for_each_presenter(const std::function<void(Presenter&, const std::string&)>& check) {
        for (size_t number = 0; number < kNumSequences; ++number) {
            for (size_t codec = 0; codec < kCodecs.size(); ++codec) {
                for (const Decoder decoder : kDecoders) {
                    Presenter presenter = make(sequence(number), codec, decoder, make_sky());
                    EXPECT_EQ(presenter.renderer().decodes_on_cpu(), decoder == Decoder::cpu);
                    check(presenter, fmt::format("{} {} {}", sequence(number).name, kCodecs[codec],
                                                 decoder == Decoder::gpu ? "gpu" : "cpu"));
                }
            }
        }
    }

    std::unique_ptr<gl::Context> context_ = gl::make_headless_context();
};

VertexColors lit_by(const Asset& asset, const LightCoefficients& light,
                    const DecodeLimits& limits) {
    return [&asset, light, limits](size_t part, double time) {
        return vertex_radiance(asset.parts[part], time, limits, light);
    };
}

// Each view is of its own camera and moment.
std::vector<std::pair<std::string, ViewState>> camera_views(Presenter& presenter,
                                                            const ViewState& start) {
    std::vector<std::pair<std::string, ViewState>> views;
    const auto add = [&](const char* name, double time, double azimuth_rad, double elevation_rad,
                         CameraTarget target, bool pose_alone) {
        ViewState view = start;
        view.animation.time = time;
        view.camera.target = target;
        view.camera.orbit.azimuth_rad = azimuth_rad;
        view.camera.orbit.elevation_rad = elevation_rad;
        view.camera.orbit = presenter.framed(view, kPictureAspect, pose_alone);
        views.emplace_back(name, view);
    };
    add("all", 0.0, 0.5, 0.3, CameraTarget::all, false);
    add("from above", 1.25, -1.2, 1.2, CameraTarget::all, true);
    add("body", 2.5, 2.5, 0.1, CameraTarget::pose, false);
    add("near", 3.0, -0.4, 0.2, CameraTarget::point, true);
    views.back().second.camera.orbit.zoom(4.0);
    return views;
}

TEST_F(PresentedPictures, AreThoseOfTheReferenceRenderer) {
    const LightCoefficients sky = EnvironmentLight(make_sky()).coefficients(kBands);
    const LightCoefficients lamps = EnvironmentLight(make_two_lamps()).coefficients(kBands);
    ASSERT_EQ(sequence(1).assets[0]->moving().root_motion.size(), kNumPoses);
    ASSERT_NE(sequence(2).assets[0]->still(), nullptr);
    ASSERT_LT(sequence(2).assets[0]->moving().num_following, kAllVertices);
    for_each_presenter([&](Presenter& presenter, const std::string& what) {
        for (const bool use_sky : {true, false}) {
            presenter.set_environment(EnvironmentLight(use_sky ? make_sky() : make_two_lamps()));
            ViewState view = black_view(0.0);
            view.light.orientation.yaw_deg = use_sky ? 130.0 : 0.0;
            LightCoefficients light =
                turn_about_y(use_sky ? sky : lamps, use_sky ? 130.0 * kPi / 180.0 : 0.0);
            if (!use_sky) {
                view.light.strength = 0.5;
                view.light.key_on = true;
                view.light.key = {60.0, 30.0, {0.2f, 1.0f, 0.3f}, 2.0, 20.0};
                const LightCoefficients key = view.light.key.coefficients(kBands);
                for (size_t i = 0; i < light.values.size(); ++i) {
                    light.values[i] = 0.5f * light.values[i] + key.values[i];
                }
            }
            for (const auto& [name, shown] : camera_views(presenter, view)) {
                const Asset& asset = presenter.asset();
                const Image expected = render_reference(
                    asset, presenter.camera(shown), shown.animation.time, shown.limits,
                    {Instance{}}, lit_by(asset, light, shown.limits), Vec3f::Zero());
                expect_same(expected, presenter.render(shown, kPictureWidth, kPictureHeight, 1),
                            Vec3f::Zero(),
                            fmt::format("{} {} {}", what, name, use_sky ? "sky" : "lamps"));
            }
        }
    });
}

// Fewer components and bands, on either side of a comparison with all there are.
TEST_F(PresentedPictures, KeepToTheirLimits) {
    const LightCoefficients light = EnvironmentLight(make_sky()).coefficients(kBands);
    for_each_presenter([&](Presenter& presenter, const std::string& what) {
        ViewState view = black_view(1.5);
        view.limits = {1, 1, 2, 0};
        view.comparison = Comparison::wipe;
        view.split = 0.5;
        view.camera.orbit = presenter.framed(view, kPictureAspect, true);
        const Asset& asset = presenter.asset();
        Image expected(kPictureWidth, kPictureHeight);
        for (const bool limited : {true, false}) {
            const DecodeLimits limits = limited ? view.limits : DecodeLimits();
            const Image half =
                render_reference(asset, presenter.camera(view), 1.5, limits, {Instance{}},
                                 lit_by(asset, light, limits), Vec3f::Zero());
            for (int y = 0; y < kPictureHeight; ++y) {
                for (int x = 0; x < kPictureWidth; ++x) {
                    if ((x < kPictureWidth / 2) == limited) expected.at(x, y) = half.at(x, y);
                }
            }
        }
        expect_same(expected, presenter.render(view, kPictureWidth, kPictureHeight, 1),
                    Vec3f::Zero(), what);
    });
}

// What is behind colours that stand for numbers.
const Vec3f kBehind = Vec3f::Constant(0.03f);

// Numbers of vertices by part, and the largest of vertices that a face has.
struct VertexNumbers {
    std::vector<std::vector<float>> values;
    float largest = 0.0f;
};

template <typename NumbersOf>
VertexNumbers vertex_numbers(const Asset& asset, const NumbersOf& numbers_of) {
    VertexNumbers numbers;
    for (const CodedMesh& mesh : asset.parts) {
        numbers.values.push_back(numbers_of(mesh));
        for (const uint32_t v : face_vertices(mesh.topology)) {
            numbers.largest = std::max(numbers.largest, std::abs(numbers.values.back()[v]));
        }
    }
    return numbers;
}

DecodedPose decoded(const CodedMesh& mesh, double time, const DecodeLimits& limits) {
    DecodedPose pose;
    MeshDecoder(mesh).decode(time, limits, pose);
    return pose;
}

TEST_F(PresentedPictures, ShowCoefficientsOfTheTransfer) {
    for_each_presenter([&](Presenter& presenter, const std::string& what) {
        for (const uint32_t coefficient : {0u, 2u, 11u}) {
            ViewState view = black_view(2.5);
            view.surface = SurfaceView::coefficient;
            view.coefficient = coefficient;
            view.channel = 0;
            view.camera.orbit = presenter.framed(view, kPictureAspect, true);
            const Asset& asset = presenter.asset();
            const VertexNumbers numbers = vertex_numbers(asset, [&](const CodedMesh& mesh) {
                const DecodedPose pose = decoded(mesh, 2.5, {});
                const size_t n = mesh.topology.num_vertices;
                const auto first = pose.transfer.begin() +
                                   static_cast<ptrdiff_t>(pose.layout.plane(0, coefficient) * n);
                return std::vector<float>(first, first + static_cast<ptrdiff_t>(n));
            });
            const VertexColors colors = [&](size_t part, double) {
                std::vector<Vec3f> shown;
                for (const float value : numbers.values[part]) {
                    shown.push_back(signed_color(value, numbers.largest));
                }
                return shown;
            };
            const Image expected = render_reference(asset, presenter.camera(view), 2.5, {},
                                                    {Instance{}}, colors, kBehind);
            expect_same(expected, presenter.render(view, kPictureWidth, kPictureHeight, 1), kBehind,
                        fmt::format("{} {}", what, coefficient));
            ASSERT_NE(presenter.painter().legend(), nullptr);
            EXPECT_FLOAT_EQ(presenter.painter().legend()->highest, numbers.largest);
        }
    });
}

// Norms of differences of two poses at every vertex, and of the second pose.
struct Norms {
    std::vector<float> difference, whole;
};

Norms transfer_norms(const CodedMesh& mesh, double time, const DecodeLimits& limits) {
    const DecodedPose some = decoded(mesh, time, limits), all = decoded(mesh, time, {});
    const size_t n = mesh.topology.num_vertices;
    Norms norms;
    for (size_t v = 0; v < n; ++v) {
        double difference = 0.0, whole = 0.0;
        for (uint32_t channel = 0; channel < all.layout.channels; ++channel) {
            for (uint32_t i = 0; i < all.layout.num_coefficients(); ++i) {
                const double value = all.transfer[all.layout.plane(channel, i) * n + v];
                const bool has = i < some.layout.num_coefficients();
                const double other =
                    has ? some.transfer[some.layout.plane(channel, i) * n + v] : 0.0;
                difference += (value - other) * (value - other);
                whole += value * value;
            }
        }
        norms.difference.push_back(static_cast<float>(std::sqrt(difference)));
        norms.whole.push_back(static_cast<float>(std::sqrt(whole)));
    }
    return norms;
}

TEST_F(PresentedPictures, ShowErrorsOfTheTransfer) {
    for_each_presenter([&](Presenter& presenter, const std::string& what) {
        ViewState view = black_view(1.0);
        view.surface = SurfaceView::transfer_error;
        view.limits = {1, 1, 3, 1};
        view.camera.orbit = presenter.framed(view, kPictureAspect, true);
        const Asset& asset = presenter.asset();
        double sum = 0.0;
        size_t count = 0;
        for (const CodedMesh& mesh : asset.parts) {
            const Norms norms = transfer_norms(mesh, 1.0, view.limits);
            for (const uint32_t v : face_vertices(mesh.topology)) {
                sum += double{norms.whole[v]} * norms.whole[v];
                ++count;
            }
        }
        const auto rms = static_cast<float>(std::sqrt(sum / static_cast<double>(count)));
        const VertexNumbers numbers = vertex_numbers(asset, [&](const CodedMesh& mesh) {
            std::vector<float> errors = transfer_norms(mesh, 1.0, view.limits).difference;
            for (float& error : errors) error /= rms;
            return errors;
        });
        ASSERT_GT(numbers.largest, 0.01f) << what;
        const VertexColors colors = [&](size_t part, double) {
            std::vector<Vec3f> shown;
            for (const float value : numbers.values[part]) {
                shown.push_back(heat_color(value / numbers.largest));
            }
            return shown;
        };
        const Image expected = render_reference(asset, presenter.camera(view), 1.0, view.limits,
                                                {Instance{}}, colors, kBehind);
        expect_same(expected, presenter.render(view, kPictureWidth, kPictureHeight, 1), kBehind,
                    what);
        EXPECT_NEAR(presenter.painter().legend()->highest, numbers.largest,
                    1e-4f * numbers.largest);
    });
}

// Four copies, each at its place and in its own time.
TEST_F(PresentedPictures, ShowEachCopyOfACrowd) {
    const LightCoefficients light = EnvironmentLight(make_sky()).coefficients(kBands);
    for_each_presenter([&](Presenter& presenter, const std::string& what) {
        ViewState view = black_view(1.25);
        view.num_instances = 4;
        view.camera.orbit = presenter.framed(view, kPictureAspect, false);
        view.camera.orbit.zoom(4.0);
        const Asset& asset = presenter.asset();
        const std::vector<Instance> crowd = make_crowd(4, sequence_bounds(asset), kNumPoses);
        const Image expected = render_reference(asset, presenter.camera(view), 1.25, view.limits,
                                                crowd, lit_by(asset, light, view.limits),
                                                Vec3f::Zero(), kCrowdWidth, kCrowdHeight);
        expect_same(expected, presenter.render(view, kCrowdWidth, kCrowdHeight, 1), Vec3f::Zero(),
                    what);
    });
}

// Without moments between poses, no copy shows one.
TEST_F(PresentedPictures, ShowWholePosesOfACrowd) {
    const LightCoefficients light = EnvironmentLight(make_sky()).coefficients(kBands);
    Presenter presenter = make(sequence(0), 0, Decoder::cpu, make_sky());
    ViewState view = black_view(1.75);
    view.num_instances = 4;
    view.animation.in_betweens = false;
    view.camera.orbit = presenter.framed(view, kPictureAspect, false);
    const Asset& asset = presenter.asset();
    std::vector<Instance> crowd = make_crowd(4, sequence_bounds(asset), kNumPoses);
    for (Instance& copy : crowd) {
        const double time = std::fmod(1.75 + copy.time_offset, double{kNumPoses});
        copy.time_offset = std::floor(time) + kNumPoses;
    }
    const Image expected = render_reference(asset, presenter.camera(view), 0.0, view.limits, crowd,
                                            lit_by(asset, light, view.limits), Vec3f::Zero(),
                                            kCrowdWidth, kCrowdHeight);
    expect_same(expected, presenter.render(view, kCrowdWidth, kCrowdHeight, 1), Vec3f::Zero(),
                "whole poses");
}

}  // namespace
}  // namespace paim::player
