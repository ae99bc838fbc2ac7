// Clustered principal components against one round of assigning the points to as many means in full
// dimension by Eigen's product, on one thread: what all rounds would start with if nothing were
// projected.
#include <Eigen/Core>

#include "analysis/bench/cluster/synthetic_points.h"
#include "analysis/bench/ratio.h"
#include "compressor/encode/cluster/clustered_pca.h"
#include "paim/base/check.h"

namespace paim::bench {

namespace {

void cluster(benchmark::State& state, uint32_t num_points, uint32_t num_planes,
             uint32_t num_columns, uint32_t num_clusters) {
    const SyntheticPoints source(num_points, num_planes, num_columns);
    Eigen::MatrixXf all(source.num_points(), source.num_dimensions());
    for (uint32_t j = 0; j < num_planes; ++j) {
        source.read(j, all.middleCols(static_cast<Eigen::Index>(j * num_columns), num_columns));
    }
    const MatrixPoints points(all, num_planes);
    ClusteringOptions options;
    options.num_clusters = num_clusters;
    const Eigen::MatrixXf means = all.topRows(num_clusters).transpose();
    ClusteredPca pca;
    run_against(
        state,
        [&] {
            const Eigen::MatrixXf products = all * means;
            benchmark::DoNotOptimize(products.data());
        },
        [&] { pca = clustered_pca(points, options); });
    const double energy = all.cast<double>().squaredNorm();
    state.counters["error"] = std::sqrt(pca.squared_error(pca.num_components) / energy);
    PAIM_CHECK_LE(static_cast<double>(state.counters["error"]), 0.5);
}

BENCHMARK_CAPTURE(cluster, small, 2000, 4, 20, 32)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cluster, vertices_42000, 42000, 25, 48, 256)
    ->UseManualTime()
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace paim::bench
