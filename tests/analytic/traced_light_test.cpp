// The traced reference against closed forms, each within the noise that it states, and with bounces
// against a bake.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "analysis/reference/traced_scene.h"
#include "compressor/bake/transfer_baker.h"
#include "paim/base/tbb_parallel.h"
#include "paim/light/environment.h"
#include "poses/shapes.h"

namespace paim {
namespace {

EnvironmentLight light_where(int height, const std::function<bool(const Vec3d&)>& is_lit) {
    Image image(2 * height, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Vec3d direction =
                direction_from_latlong((x + 0.5) / image.width, (y + 0.5) / image.height);
            if (is_lit(direction)) image.at(x, y) = Vec3f(1.0f, 0.5f, 2.0f);
        }
    }
    return EnvironmentLight(std::move(image));
}

TracedMesh first_pose(const poses::Sequence& sequence) {
    const Pose pose = poses::make_pose_set(sequence, 1).load_pose(0);
    return {sequence.topology(), sequence.albedo(), pose.positions, pose.normals};
}

struct Statistics {
    double mean_error = 0.0, rms_error = 0.0, rms_noise = 0.0;
    int count = 0;
};

// Errors of the first channel, whose light is 1, where `expected` is a number.
Statistics compare(const TracedMesh& mesh, const EnvironmentLight& map, uint32_t rays,
                   const std::function<double(const Vec3d& normal)>& expected) {
    const TracedScene scene(mesh, TracedMesh());
    const LightSampler sampler(map);
    const DirectLight light(sampler, rays, 1);
    TraceSettings settings;
    const VertexLight traced = scene.light_vertices(light, settings);
    Statistics sums;
    for (size_t v = 0; v < mesh.normals.size(); ++v) {
        const double truth = expected(mesh.normals[v].cast<double>().normalized());
        if (std::isnan(truth)) continue;
        const Vec3f a = traced.terms[0][0][v], b = traced.terms[0][1][v];
        const double error = 0.5 * static_cast<double>(a.x() + b.x()) - truth;
        const double noise = 0.5 * static_cast<double>(a.x() - b.x());
        sums.mean_error += error;
        sums.rms_error += error * error;
        sums.rms_noise += noise * noise;
        ++sums.count;
        // Light is of one colour.
        EXPECT_NEAR(a.z(), 4.0f * a.y(), 1e-5f);
    }
    sums.mean_error /= sums.count;
    sums.rms_error = std::sqrt(sums.rms_error / sums.count);
    sums.rms_noise = std::sqrt(sums.rms_noise / sums.count);
    return sums;
}

// Half of a vertex's rays are those of one of 64 sets, so the mean error is at least as good as that of 64
// independent vertices: within four of its standard errors of 0. The stated
// noise is that of the errors, to what so many vertices tell: the square of each RMS varies by about
// √(2 / count) of itself, and by as much again where errors are not normal or shared.
void expect_true_to_noise(const Statistics& sums, double most_noise) {
    EXPECT_GT(sums.count, 200);
    EXPECT_LT(sums.rms_noise, most_noise);
    EXPECT_GT(sums.rms_noise, 0.0);
    EXPECT_LT(std::abs(sums.mean_error), 4.0 * sums.rms_noise / std::sqrt(64.0));
    EXPECT_NEAR(sums.rms_error / sums.rms_noise, 1.0, 4.0 * 2.0 * std::sqrt(1.0 / sums.count));
}

// White furnace: an open vertex in constant light 1 reflects 1.
TEST(TracedLight, OfAWhiteFurnaceIsOne) {
    const auto sphere = poses::make_sphere_sequence(2000);
    const EnvironmentLight map = light_where(16, [](const Vec3d&) { return true; });
    expect_true_to_noise(compare(first_pose(*sphere), map, 256, [](const Vec3d&) { return 1.0; }),
                         0.05);
}

// The upper half of the sky, on an unshadowed surface at any angle: (1 + cos θ) / 2.
TEST(TracedLight, OfHalfASkyFollowsTheTilt) {
    const auto sphere = poses::make_sphere_sequence(2000);
    const EnvironmentLight map = light_where(64, [](const Vec3d& d) { return d.y() > 0.0; });
    expect_true_to_noise(compare(first_pose(*sphere), map, 256,
                                 [](const Vec3d& normal) { return 0.5 * (1.0 + normal.y()); }),
                         0.05);
}

// A disc of angular radius α about the zenith: sin² α cos θ where all of it is above the horizon, and
// nothing where all of it is below.
TEST(TracedLight, OfADiscIsThatOfItsCosine) {
    const auto sphere = poses::make_sphere_sequence(2000);
    const double alpha = 10.0 * kPi / 180.0;
    // Rows of the map end at multiples of 1°, so that the disc is exact.
    const EnvironmentLight map =
        light_where(180, [&](const Vec3d& d) { return std::acos(d.y()) < alpha; });
    const double disc = std::sin(alpha) * std::sin(alpha);
    const TracedMesh mesh = first_pose(*sphere);
    const auto lit = compare(mesh, map, 256, [&](const Vec3d& normal) {
        return std::acos(normal.y()) < 0.5 * kPi - alpha - 0.05 ? disc * normal.y() : std::nan("");
    });
    expect_true_to_noise(lit, 0.03 * disc);
    const auto dark = compare(mesh, map, 256, [&](const Vec3d& normal) {
        return std::acos(normal.y()) > 0.5 * kPi + alpha + 0.05 ? 0.0 : std::nan("");
    });
    EXPECT_EQ(dark.rms_error, 0.0);
}

// Light that bounces in a bowl is that of a bake with as many bounces, under light that a bake holds
// exactly: constant light.
TEST(TracedLight, BouncesAsOftenAsTheBake) {
    const auto bowl = poses::make_bowl_sequence(1500);
    const TracedMesh mesh = first_pose(*bowl);
    BakeOptions options;
    options.bands = 1;
    options.rays = 2048;
    options.bounces = 2;
    const TransferBaker baker(options, bowl->albedo());
    const BakedPose baked = baker.bake(bowl->topology(), {mesh.positions, mesh.normals}, 0);
    const TracedScene scene(mesh, TracedMesh());
    const EnvironmentLight map = light_where(16, [](const Vec3d&) { return true; });
    const LightSampler sampler(map);
    const DirectLight light(sampler, 1024, 1);
    TraceSettings settings;
    settings.bounces = 2;
    const VertexLight traced = scene.light_vertices(light, settings);
    ASSERT_EQ(traced.terms.size(), 3u);
    const std::vector<Vec3f> halves[2] = {traced.half(0), traced.half(1)};
    double difference = 0.0, noise = 0.0, bounced = 0.0;
    const size_t count = mesh.normals.size();
    for (size_t v = 0; v < count; ++v) {
        const double mean = 0.5 * static_cast<double>(halves[0][v].x() + halves[1][v].x());
        const double d = 0.5 * static_cast<double>(halves[0][v].x() - halves[1][v].x());
        const double of_bake = std::sqrt(4.0 * kPi) * static_cast<double>(baked.transfer[v]);
        const double n = std::sqrt(4.0 * kPi) * static_cast<double>(baked.noise[v]);
        difference += mean - of_bake;
        noise += d * d + n * n;
        bounced +=
            mean - 0.5 * static_cast<double>(traced.terms[0][0][v].x() + traced.terms[0][1][v].x());
    }
    // Bounced light of neighbours shares errors; ten standard errors of independent ones.
    EXPECT_LT(std::abs(difference), 10.0 * std::sqrt(noise));
    // Without one of the bounces the test would fail.
    EXPECT_GT(bounced, 100.0 * std::sqrt(noise));
}

// Points of triangles see what vertices see: on a fine sphere, all of it.
TEST(TracedLight, OfPointsOfTrianglesIsOneInAFurnace) {
    const auto sphere = poses::make_sphere_sequence(2000);
    const TracedMesh mesh = first_pose(*sphere);
    const TracedScene scene(mesh, TracedMesh());
    const EnvironmentLight map = light_where(16, [](const Vec3d&) { return true; });
    const LightSampler sampler(map);
    const DirectLight light(sampler, 256, 1);
    std::vector<TracedPoint> points;
    for (uint32_t t = 0; t < mesh.topology.triangles.size(); t += 3)
        points.push_back({t, 0.3f, 0.2f});
    TraceSettings settings;
    const std::vector<LightHalves> traced =
        scene.light_points(points, light, settings, VertexLight());
    double error = 0.0, noise = 0.0;
    for (const LightHalves& halves : traced) {
        error += 0.5 * static_cast<double>(halves[0].x() + halves[1].x()) - 1.0;
        const double d = 0.5 * static_cast<double>(halves[0].x() - halves[1].x());
        noise += d * d;
    }
    // Faces next to a point of a convex mesh may hide a sliver above its interpolated horizon, of the
    // angle between neighbouring normals squared: below 1 % here.
    const double count = static_cast<double>(points.size());
    EXPECT_LT(std::abs(error) / count, 4.0 * std::sqrt(noise / count / 64.0) + 0.003);
}

TEST(TracedLight, DoesNotDependOnThreads) {
    const auto sphere = poses::make_sphere_sequence(500);
    const TracedMesh mesh = first_pose(*sphere);
    const EnvironmentLight map = light_where(16, [](const Vec3d& d) { return d.x() > 0.2; });
    const LightSampler sampler(map);
    const DirectLight light(sampler, 256, 1);
    const auto trace = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        return TracedScene(mesh, TracedMesh()).light_vertices(light, {}).terms[0][0];
    };
    EXPECT_EQ(trace(1), trace(2));
}

}  // namespace
}  // namespace paim
