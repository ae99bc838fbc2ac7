// Baking against bare Embree: the same rays in the same order and scene, with nothing round them,
// one by one (rtcOccluded1) and sixteen at a time (rtcOccluded16) as the baker traces them.
#include "analysis/bench/bare_rays.h"
#include "analysis/bench/ratio.h"
#include "compressor/bake/cosine_directions.h"
#include "compressor/bake/ray_start.h"
#include "compressor/bake/transfer_baker.h"
#include "paim/base/check.h"
#include "paim/base/tbb_parallel.h"
#include "paim/mesh/normals.h"
#include "paim/trace/ray_scene.h"
#include "poses/octopus.h"

namespace paim::bench {

namespace {

constexpr size_t kOriginsPerPiece = 64;  // as the baker

// The rays that TransferBaker traces for pose 0.
RayList rays_of_bake(const PoseSource& source, const Pose& pose, const BakeOptions& options) {
    const CosineDirections generator(options.rays, 2);
    const RayStarts starts(source.topology(), pose.positions, pose.normals);
    PAIM_CHECK_EQ(starts.num_fans(), size_t{0});  // of the octopus; their rays are other work
    RayList rays;
    rays.per_origin = options.rays;
    DirectionArrays half;
    for (uint32_t v = 0; v < source.topology().num_vertices; ++v) {
        rays.origins.push_back(starts[v].origin);
        for (uint32_t h = 0; h < 2; ++h) {
            generator.generate(pose.normals[v], half_keys(options, 0, v, 0)[0], h, half);
            for (uint32_t j = 0; j < generator.count(); ++j) {
                rays.directions.emplace_back(half.x[j], half.y[j], half.z[j]);
            }
        }
    }
    return rays;
}

enum class Bare { rays, packets };

void bake(benchmark::State& state, Bare bare, uint32_t num_vertices, uint32_t num_rays) {
    const PoseSet octopus = poses::make_octopus(num_vertices, 1);
    const Pose pose = octopus.load_pose(0);
    const BakeOptions options{5, num_rays, 1};
    const TransferBaker baker(options);
    const BareScene scene(octopus.topology(), pose.positions);
    const RayList rays = rays_of_bake(octopus, pose, options);
    uint64_t bare_blocked = 0;
    PoseStatistics statistics;
    run_against(
        state,
        [&] {
            bare_blocked = bare == Bare::rays
                               ? scene.count_blocked(rays, kOriginsPerPiece)
                               : scene.count_blocked_by_packets(rays, kOriginsPerPiece);
        },
        [&] { statistics = baker.bake(octopus.topology(), pose, 0).statistics; });
    // Otherwise it was not the same work.
    PAIM_CHECK_EQ(bare_blocked, statistics.occluded);
    PAIM_CHECK_EQ(uint64_t{num_vertices} * num_rays, statistics.rays);
    const auto rays_total = static_cast<double>(statistics.rays);
    state.counters["occluded"] = static_cast<double>(statistics.occluded) / rays_total;
    state.counters["ns_per_ray"] = 1e9 * state.counters["ours_cpu_s"] / rays_total;
    state.counters["scene_cpu_s"] =
        timed([&] { const RayScene built(octopus.topology(), pose.positions); }).cpu_s;
}

// The same bake on one thread and on several: ratio_wall is how many times faster they are
// together.
void bake_threads(benchmark::State& state, uint32_t num_vertices, uint32_t num_rays, int threads) {
    const PoseSet octopus = poses::make_octopus(num_vertices, 1);
    const Pose pose = octopus.load_pose(0);
    const TransferBaker baker(BakeOptions{5, num_rays, 1});
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        return baker.bake(octopus.topology(), pose, 0).transfer;
    };
    run_against(
        state, [&] { benchmark::DoNotOptimize(run(1)); },
        [&] { benchmark::DoNotOptimize(run(threads)); });
}

// Making directions alone, which is most of what surrounds the rays.
void directions(benchmark::State& state, uint32_t num_rays) {
    const CosineDirections generator(num_rays, 1);
    DirectionArrays out;
    const Vec3f normal = Vec3f(0.3f, -0.8f, 0.5f).normalized();
    uint64_t key = 0;
    for (auto _ : state) {
        generator.generate(normal, ++key * 0x9e3779b97f4a7c15u, 0, out);
        benchmark::DoNotOptimize(out.x.data());
        benchmark::ClobberMemory();
    }
    state.counters["per_ray"] = benchmark::Counter(
        num_rays, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(bake, small, Bare::packets, 1000, 64)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bake, vertices_10000_rays_256_against_rtcOccluded1, Bare::rays, 10000, 256)
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bake, vertices_10000_rays_256_against_rtcOccluded16, Bare::packets, 10000, 256)
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(bake_threads, vertices_20000_rays_512_two_against_one, 20000, 512, 2)
    ->UseManualTime()
    ->Iterations(7)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(directions, rays_128, 128);

}  // namespace

}  // namespace paim::bench
