// Traced paths against quadrature, closed forms and themselves, each within the noise that it states.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "analysis/reference/path/path_picture.h"
#include "compressor/material/brdfs.h"
#include "paim/base/gauss_legendre.h"
#include "paim/base/tbb_parallel.h"
#include "paim/light/environment.h"
#include "paim/mesh/bounds.h"
#include "poses/shapes.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

const char* const kBrdfs[] = {"phong:0.5,5", "phong:0.9,60", "cook-torrance:0.5,0.8",
                              "cook-torrance:0.04,0.4"};

PathMaterials all_of(std::shared_ptr<const Brdf> brdf, const Vec3f& tint = Vec3f::Ones()) {
    PathMaterials materials;
    materials.materials.glossy = {{brdf->text(), tint}};
    materials.materials.of_vertex = {1};
    materials.brdfs = {std::move(brdf)};
    return materials;
}

// A triangle in the plane z = height, far larger than what is near the origin.
TracedMesh floor_at(float height, bool faces_up, float albedo) {
    const float z = faces_up ? 1.0f : -1.0f;
    TracedMesh mesh;
    mesh.topology = {3, {faces_up ? Triangle{0, 1, 2} : Triangle{0, 2, 1}}};
    mesh.albedo.values = {Vec3f::Constant(albedo)};
    mesh.positions = {{-90, -90, height}, {180, -90, height}, {-90, 180, height}};
    mesh.normals.assign(3, Vec3f(0, 0, z));
    return mesh;
}

TracedMesh first_pose(const poses::Sequence& sequence, float albedo) {
    const Pose pose = poses::make_pose_set(sequence, 1).load_pose(0);
    Albedo grey{{Vec3f::Constant(albedo)}};
    return {sequence.topology(), grey, pose.positions, pose.normals};
}

EnvironmentLight map_of(int height, const std::function<float(const Vec3d&)>& radiance) {
    Image image(2 * height, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            image.at(x, y) =
                radiance(direction_from_latlong((x + 0.5) / image.width, (y + 0.5) / height)) *
                Vec3f(1.0f, 0.5f, 2.0f);
        }
    }
    return EnvironmentLight(std::move(image));
}

PathSettings settings_of(uint32_t paths, uint32_t bounces = 0) {
    PathSettings settings;
    settings.paths = paths;
    settings.bounces = bounces;
    return settings;
}

// Within five standard errors, which chance alone passes once in a hundred thousand times (Student's
// distribution of 15 degrees of freedom), and within what the expected value is known to.
void expect_value(const PathEstimate& estimate, double expected, double known_to) {
    const auto error = static_cast<double>(estimate.standard_error.x());
    EXPECT_NEAR(static_cast<double>(estimate.mean.x()), expected, 5.0 * error + known_to);
    // The channels are those of the light.
    EXPECT_NEAR(estimate.mean.z(), 4.0f * estimate.mean.y(), 1e-4f * std::abs(estimate.mean.z()));
}

// ∫ f cos θ over the hemisphere, by the middles of small cells.
double directional_albedo(const Brdf& brdf, const Vec3d& out) {
    constexpr int kRings = 500, kAround = 500;
    double sum = 0.0;
    for (int r = 0; r < kRings; ++r) {
        const double radius = std::sqrt((r + 0.5) / kRings);  // rings of equal area below
        for (int a = 0; a < kAround; ++a) {
            const double angle = 2.0 * kPi * (a + 0.5) / kAround;
            sum += brdf.value({radius * std::cos(angle), radius * std::sin(angle),
                               std::sqrt(1.0 - radius * radius)},
                              out);
        }
    }
    return sum * kPi / (kRings * kAround);
}

// White furnace: in constant light 1 a surface sends out its directional albedo.
TEST(PathTracer, OfAWhiteFurnaceIsTheDirectionalAlbedo) {
    const MapLight light(map_of(8, [](const Vec3d&) { return 1.0f; }));
    for (const char* text : kBrdfs) {
        const PathMaterials materials = all_of(parse_brdf(text));
        const PathTracer tracer(floor_at(0.0f, true, 0.0f), materials, light);
        for (const double angle : {0.0, 0.7, 1.2}) {
            const Vec3d out(std::sin(angle), 0.0, std::cos(angle));
            const PathStart start{{0, 0.3f, 0.3f}, out.cast<float>()};
            const PathEstimate estimate = tracer.trace({&start, 1}, settings_of(512))[0];
            const double expected = directional_albedo(*materials.brdfs[0], out);
            SCOPED_TRACE(text);
            // Cells of 500 in a lobe that is 0.1 wide or wider: second order, below 1e-4 of it.
            expect_value(estimate, expected, 2e-4 * expected);
            EXPECT_LT(static_cast<double>(estimate.standard_error.x()), 0.01 * expected);
        }
    }
}

// A Lambertian surface weighs every direction that its cosine draws alike: no noise at all.
TEST(PathTracer, OfADiffuseFurnaceHasNoNoise) {
    LightCoefficients one{1, {Vec3f(1.0f, 0.5f, 2.0f) * static_cast<float>(std::sqrt(4.0 * kPi))}};
    const BandLight light(one);
    const PathMaterials nothing;
    const PathTracer tracer(floor_at(0.0f, true, 0.7f), nothing, light);
    const PathStart start{{0, 0.3f, 0.3f}, Vec3f(0.6f, 0.0f, 0.8f)};
    const PathEstimate estimate = tracer.trace({&start, 1}, settings_of(16))[0];
    EXPECT_NEAR(estimate.mean.x(), 0.7f, 1e-6f);
    EXPECT_LT(estimate.standard_error.x(), 1e-6f);
}

// One lamp, a pixel of a map, over a sphere: by quadrature over the pixel at each point.
TEST(PathTracer, OfASphereUnderALampIsItsQuadrature) {
    constexpr int kHeight = 12, kX = 7, kY = 3;
    Image image(2 * kHeight, kHeight);
    image.at(kX, kY) = Vec3f(1.0f, 0.5f, 2.0f);
    const MapLight light{EnvironmentLight(image)};
    const TracedMesh sphere = first_pose(*poses::make_sphere_sequence(640), 0.3f);
    std::vector<std::pair<Vec3d, double>> lamp;  // directions and solid angles
    const auto around = gauss_legendre(24, static_cast<double>(kX) / image.width,
                                       static_cast<double>(kX + 1) / image.width);
    const auto down = gauss_legendre(24, std::sin(kPi * (0.5 - (kY + 1.0) / kHeight)),
                                     std::sin(kPi * (0.5 - static_cast<double>(kY) / kHeight)));
    for (const auto& [u, u_weight] : around) {
        for (const auto& [sine, sine_weight] : down) {
            lamp.emplace_back(direction_from_latlong(u, 0.5 - std::asin(sine) / kPi),
                              2.0 * kPi * u_weight * sine_weight);
        }
    }
    const Vec3d middle = direction_from_latlong((kX + 0.5) / image.width, (kY + 0.5) / kHeight);
    for (const char* text : kBrdfs) {
        SCOPED_TRACE(text);
        const PathMaterials materials = all_of(parse_brdf(text));
        const PathTracer tracer(sphere, materials, light);
        int count = 0;
        for (uint32_t f = 0; f < sphere.topology.triangles.size(); f += 23) {
            const Triangle& t = sphere.topology.triangles[f];
            const Vec3d normal = (0.2f * sphere.normals[t[0]] + 0.3f * sphere.normals[t[1]] +
                                  0.5f * sphere.normals[t[2]])
                                     .cast<double>()
                                     .normalized();
            // All of the lamp is above the triangle, and the eye above the surface.
            if (normal.dot(middle) < 0.4) continue;
            const Vec3d eye = (normal + Vec3d(0.3, 0.5, -0.2)).normalized();
            const PathStart start{{f, 0.3f, 0.5f}, eye.cast<float>()};
            const Eigen::Quaterniond turn =
                Eigen::Quaterniond::FromTwoVectors(normal, Vec3d::UnitZ());
            double expected = 0.0;
            for (const auto& [direction, solid_angle] : lamp) {
                const Vec3d in = turn * direction;
                expected +=
                    solid_angle * in.z() * (0.3 / kPi + materials.brdfs[0]->value(in, turn * eye));
            }
            expect_value(tracer.trace({&start, 1}, settings_of(256))[0], expected, 1e-4 * expected);
            ++count;
        }
        EXPECT_GT(count, 10);
    }
}

// Standard errors are those of independent draws: starts at the same place have other numbers.
TEST(PathTracer, StatesItsNoise) {
    constexpr size_t kCount = 400;
    const MapLight light(map_of(16, [](const Vec3d& d) { return d.x() > 0.6 ? 3.0f : 0.1f; }));
    const PathMaterials materials = all_of(parse_brdf("phong:0.5,20"));
    const PathTracer tracer(first_pose(*poses::make_bowl_sequence(300), 0.5f), materials, light);
    const std::vector<PathStart> starts(kCount, {{10, 0.3f, 0.3f}, Vec3f(0.0f, 1.0f, 0.0f)});
    const std::vector<PathEstimate> estimates = tracer.trace(starts, settings_of(8, 2));
    double sum = 0.0, squares = 0.0, stated = 0.0;
    for (const PathEstimate& estimate : estimates) {
        const auto mean = static_cast<double>(estimate.mean.x());
        sum += mean;
        squares += mean * mean;
        stated += std::pow(static_cast<double>(estimate.standard_error.x()), 2) / kCount;
    }
    const double spread = (squares - sum * sum / kCount) / (kCount - 1);
    // Both variances are known to √(2 / 399), 7 %, and √(2 / 15 / 400), 2 %, of themselves: four
    // times both together.
    EXPECT_NEAR(stated / spread, 1.0, 0.3);
    EXPECT_GT(spread, 0.0);
    // Another seed gives other numbers, the same one the same.
    PathSettings other = settings_of(8, 2);
    other.seed = 2;
    const std::span first(starts.data(), 1);
    EXPECT_NE(tracer.trace(first, other)[0].mean, estimates[0].mean);
    EXPECT_EQ(tracer.trace(first, settings_of(8, 2))[0].mean, estimates[0].mean);
}

// In a hemisphere of albedo ρ every bounce adds ρ/2 of the one before (docs/algorithms/bounces.md).
TEST(PathTracer, BouncesInABowlAreAGeometricSeries) {
    constexpr double kAlbedo = 0.8;
    const MapLight light(map_of(8, [](const Vec3d&) { return 1.0f; }));
    const TracedMesh bowl = first_pose(*poses::make_bowl_sequence(4000), 0.0f);
    TracedMesh diffuse = bowl;
    diffuse.albedo.values = {Vec3f::Constant(static_cast<float>(kAlbedo))};
    const PathMaterials nothing, glossy = all_of(std::make_shared<Lambertian>(kAlbedo));
    // Diffuse as an albedo and diffuse as a BRDF are the same.
    const PathTracer tracers[] = {{diffuse, nothing, light}, {bowl, glossy, light}};
    for (const PathTracer& tracer : tracers) {
        double expected = 0.0;
        for (uint32_t bounces = 0; bounces < 4; ++bounces) {
            expected += kAlbedo * 0.5 * std::pow(0.5 * kAlbedo, bounces);
            const PathStart start{{1000, 0.3f, 0.3f}, Vec3f(0.0f, 1.0f, 0.0f)};
            // Triangles lie inside the sphere by their sagitta, which opens 0.001 of the sky.
            expect_value(tracer.trace({&start, 1}, settings_of(1024, bounces))[0], expected, 2e-3);
        }
    }
}

// Light is found by the map and the reflection together, or by the reflection alone: with the same
// expectation, over glossy bounces.
TEST(PathTracer, FindsLightInBothWays) {
    const auto radiance = [](const Vec3d& d) { return static_cast<float>(1.0 + 0.6 * d.x()); };
    const EnvironmentLight map = map_of(64, radiance);
    const MapLight by_map(map);
    const BandLight by_bands(map.coefficients(2));
    const PathMaterials materials = all_of(parse_brdf("cook-torrance:0.7,0.5"));
    const TracedMesh bowl = first_pose(*poses::make_bowl_sequence(300), 0.2f);
    const PathTracer one(bowl, materials, by_map), other(bowl, materials, by_bands);
    for (uint32_t f = 5; f < 400; f += 90) {
        const PathStart start{{f, 0.2f, 0.2f}, Vec3f(0.0f, 1.0f, 0.0f)};
        const PathEstimate a = one.trace({&start, 1}, settings_of(512, 2))[0];
        const PathEstimate b = other.trace({&start, 1}, settings_of(512, 2))[0];
        // Pixels are constant over 1/64 of π: relative to the light, (π/64)²/24 = 1e-4.
        expect_value(a, static_cast<double>(b.mean.x()),
                     5.0 * static_cast<double>(b.standard_error.x()) + 2e-4);
    }
}

TEST(PathTracer, BacksGiveNoLight) {
    const MapLight light(map_of(8, [](const Vec3d&) { return 1.0f; }));
    const PathMaterials nothing;
    const PathStart start{{0, 0.3f, 0.3f}, Vec3f(0.0f, 0.0f, 1.0f)};
    // A ceiling over all of the floor's sky but 0.01 of it. Its front sees as little sky.
    const auto trace = [&](bool ceiling_faces_up) {
        TracedMesh mesh = floor_at(0.0f, true, 1.0f);
        mesh.append(floor_at(20.0f, ceiling_faces_up, 1.0f));
        return PathTracer(mesh, nothing, light).trace({&start, 1}, settings_of(256, 1))[0];
    };
    const PathEstimate back = trace(true), front = trace(false);
    const auto difference = static_cast<double>(front.mean.x() - back.mean.x());
    EXPECT_GT(difference, 5.0 * static_cast<double>(front.standard_error.x()));
    TracedMesh open = floor_at(0.0f, true, 1.0f);
    open.append(floor_at(20.0f, true, 1.0f));
    const PathEstimate direct =
        PathTracer(open, nothing, light).trace({&start, 1}, settings_of(256, 0))[0];
    expect_value(back, static_cast<double>(direct.mean.x()), 0.0);
}

// What the seen surface reflects is chosen; tints and corners count by their weights.
TEST(PathTracer, MixesCornersAndKinds) {
    const MapLight light(map_of(8, [](const Vec3d&) { return 1.0f; }));
    PathMaterials materials;
    materials.materials.glossy = {{"lambertian:0.4", Vec3f(1.0f, 0.25f, 1.0f)}};
    materials.materials.of_vertex = {0, 1, 1};
    materials.brdfs = {std::make_shared<Lambertian>(0.4)};
    const PathTracer tracer(floor_at(0.0f, true, 0.5f), materials, light);
    const PathStart start{{0, 0.3f, 0.2f}, Vec3f(0.0f, 0.0f, 1.0f)};
    const auto trace = [&](bool diffuse, bool glossy) -> Vec3f {
        PathSettings settings = settings_of(2048);
        settings.seen = {diffuse, glossy};
        return tracer.trace({&start, 1}, settings)[0].mean;
    };
    const Vec3f sky(1.0f, 0.5f, 2.0f), tint(1.0f, 0.25f, 1.0f);
    // Standard errors of 32,768 paths of nearly even weights are below 0.001.
    EXPECT_LT((trace(true, false) - 0.5f * sky).norm(), 5e-3f);
    EXPECT_LT((trace(false, true) - 0.5f * 0.4f * tint.cwiseProduct(sky)).norm(), 5e-3f);
    EXPECT_LT((trace(true, true) - (0.5f * sky + 0.2f * tint.cwiseProduct(sky))).norm(), 5e-3f);
    EXPECT_EQ(trace(false, false), Vec3f::Zero());
}

// The choice is for the seen surface alone: what it sees reflects all.
TEST(PathTracer, SeesBouncesOfAllKinds) {
    const MapLight light(map_of(8, [](const Vec3d&) { return 1.0f; }));
    const PathMaterials materials = all_of(std::make_shared<Lambertian>(0.3));
    const PathTracer tracer(first_pose(*poses::make_bowl_sequence(4000), 0.5f), materials, light);
    const PathStart start{{1000, 0.3f, 0.3f}, Vec3f(0.0f, 1.0f, 0.0f)};
    PathSettings settings = settings_of(1024, 1);
    settings.seen.diffuse = false;
    // 0.3 of half the sky, and of half the bowl, which reflects 0.8 of half the sky.
    expect_value(tracer.trace({&start, 1}, settings)[0], 0.3 * (0.5 + 0.5 * 0.8 * 0.5), 1e-3);
}

// A picture has the paths of its pixels, seen from the eye, and nothing where no mesh is.
TEST(PathPicture, ShowsWhatThePathsOfItsPixelsFind) {
    use_tbb();
    const MapLight light(map_of(8, [](const Vec3d& d) { return d.y() > 0.0 ? 1.0f : 0.0f; }));
    const PathMaterials materials = all_of(parse_brdf("phong:0.5,20"));
    const TracedMesh sphere = first_pose(*poses::make_sphere_sequence(300), 0.3f);
    const PathTracer tracer(sphere, materials, light);
    Bounds bounds;
    bounds.extend(sphere.positions);
    const Camera camera = frame_bounds(bounds, 1.0f);
    const VisiblePoints visible = find_visible(sphere.topology, sphere.positions, camera, 24, 24);
    const PathPicture picture = trace_picture(tracer, visible, camera, settings_of(16));
    EXPECT_EQ(picture.mean.at(0, 0), Vec3f::Zero());
    size_t number = 0;
    std::vector<PathStart> starts;
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 24; ++x) {
            const Hit& hit = visible.hits[static_cast<size_t>(24 * y + x)];
            if (hit.triangle == kNoTriangle) continue;
            const Triangle& t = sphere.topology.triangles[hit.triangle];
            const Vec3f place = (1.0f - hit.u - hit.v) * sphere.positions[t[0]] +
                                hit.u * sphere.positions[t[1]] + hit.v * sphere.positions[t[2]];
            starts.push_back(
                {{hit.triangle, hit.u, hit.v}, Vec3f((camera.eye - place).normalized())});
        }
    }
    const std::vector<PathEstimate> estimates = tracer.trace(starts, settings_of(16));
    for (int y = 0; y < 24; ++y) {
        for (int x = 0; x < 24; ++x) {
            if (visible.hits[static_cast<size_t>(24 * y + x)].triangle == kNoTriangle) continue;
            // The eye's direction is computed in another way, with roundings of floats.
            EXPECT_LT((picture.mean.at(x, y) - estimates[number].mean).norm(), 1e-4f);
            ++number;
        }
    }
    EXPECT_GT(number, 100u);
}

}  // namespace
}  // namespace paim
