// Baking against the plain loop of pbrt-v2 at the same error: fewer rays, and less work a ray.
#include <cmath>

#include "analysis/bench/ratio.h"
#include "analysis/bench/sphere_net.h"
#include "compressor/bake/ray_start.h"
#include "compressor/bake/transfer_baker.h"
#include "paim/base/check.h"
#include "poses/octopus.h"

namespace paim::bench {

namespace {

// Relative RMS.
double error_of(std::span<const float> transfer, std::span<const float> truth) {
    double error = 0.0, energy = 0.0;
    for (size_t r = 0; r < truth.size(); ++r) {
        error += std::pow(double{transfer[r]} - truth[r], 2.0);
        energy += double{truth[r]} * truth[r];
    }
    return std::sqrt(error / energy);
}

// The fewest rays of a bake, to a percent or so, whose error is at most that of the reference.
template <typename ErrorOf>
uint32_t rays_of_error(double error, uint32_t first_guess, const ErrorOf& error_of_rays) {
    uint32_t rays = first_guess;
    for (int round = 0; round < 4; ++round) {
        const double ratio = error_of_rays(rays) / error;
        rays = 2 * static_cast<uint32_t>(std::ceil(0.5 * rays * std::pow(ratio, 1.0 / 0.75)));
    }
    while (error_of_rays(rays) > error) rays += 2;
    return rays;
}

void bake_sphere_net(benchmark::State& state, uint32_t num_vertices, uint32_t num_points,
                     uint32_t truth_rays) {
    constexpr size_t kOriginsPerPiece = 64;  // as the baker
    const PoseSet octopus = poses::make_octopus(num_vertices, 1);
    const Topology& topology = octopus.topology();
    const Pose pose = octopus.load_pose(0);
    const SphereNet net{.num_points = num_points};
    const std::vector<float> truth =
        TransferBaker({net.bands, truth_rays, 77}).bake(topology, pose, 0).transfer;

    const RayStarts starts(topology, pose.positions, pose.normals);
    PAIM_CHECK_EQ(starts.num_fans(), size_t{0});  // of the octopus; their rays are other work
    std::vector<Vec3f> origins;
    for (uint32_t v = 0; v < num_vertices; ++v) origins.push_back(starts[v].origin);
    std::vector<float> theirs, ours;
    const auto bake_as_pbrt = [&] {
        const BareScene scene(topology, pose.positions);
        theirs = sphere_net_transfer(scene, origins, pose.normals, net, kOriginsPerPiece);
    };
    bake_as_pbrt();
    const double error = error_of(theirs, truth);
    const uint32_t rays = rays_of_error(error, num_points / 4, [&](uint32_t count) {
        ours = TransferBaker({net.bands, count, 1}).bake(topology, pose, 0).transfer;
        return error_of(ours, truth);
    });
    const TransferBaker baker({net.bands, rays, 1});
    run_against(state, bake_as_pbrt, [&] { ours = baker.bake(topology, pose, 0).transfer; });
    PAIM_CHECK_LE(error_of(ours, truth), error);
    state.counters["error"] = error;
    state.counters["rays"] = rays;
    state.counters["vertices_per_cpu_s"] = num_vertices / state.counters["ours_cpu_s"];
    state.counters["reference_vertices_per_cpu_s"] =
        num_vertices / state.counters["reference_cpu_s"];
}

BENCHMARK_CAPTURE(bake_sphere_net, small, 1000, 64, 1024)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bake_sphere_net, vertices_5000_points_256, 5000, 256, 16384)
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bake_sphere_net, vertices_5000_points_1024, 5000, 1024, 16384)
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bake_sphere_net, vertices_5000_points_4096, 5000, 4096, 16384)
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace paim::bench
