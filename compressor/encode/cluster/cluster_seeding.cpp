// The first means of clusters.
// Based on: Arthur and Vassilvitskii 2007 (see the header)
#include "compressor/encode/cluster/cluster_seeding.h"

#include <algorithm>
#include <limits>

#include "paim/base/parallel.h"
#include "paim/base/seed.h"

namespace paim {

using Eigen::Index;

namespace {

constexpr Index kCoordinates = 32;
constexpr size_t kGrain = 4096;

// The point at which the running sum of the weights passes `at`; sums [blocks] are of kGrain each.
uint32_t find(const std::vector<float>& weight, const std::vector<double>& sums, double at) {
    size_t block = 0;
    while (block + 1 < sums.size() && at >= sums[block]) at -= sums[block++];
    uint32_t last = 0;  // that has a weight, in case rounding leads past the end
    for (size_t v = block * kGrain; v < std::min(weight.size(), (block + 1) * kGrain); ++v) {
        if (!(weight[v] > 0.0f)) continue;
        last = static_cast<uint32_t>(v);
        at -= static_cast<double>(weight[v]);
        if (at < 0.0) break;
    }
    return last;
}

}  // namespace

std::vector<uint32_t> seed_clusters(const Eigen::MatrixXf& points, uint32_t num_clusters,
                                    uint64_t seed) {
    const auto num_points = static_cast<size_t>(points.cols());
    std::vector<uint32_t> chosen;
    if (num_points == 0 || num_clusters == 0) return chosen;
    const Eigen::MatrixXf places = points.topRows(std::min(kCoordinates, points.rows()));
    RandomStream random(stream_key(seed, num_points, num_clusters));
    std::vector<float> distance(num_points, std::numeric_limits<float>::max());
    std::vector<double> sums((num_points + kGrain - 1) / kGrain);
    chosen.push_back(static_cast<uint32_t>(random.uniform() * static_cast<double>(num_points)));
    while (chosen.size() < num_clusters) {
        const Eigen::VectorXf last = places.col(static_cast<Index>(chosen.back()));
        parallel_for(num_points, kGrain, [&](size_t begin, size_t end) {
            double sum = 0.0;
            for (size_t v = begin; v < end; ++v) {
                const float d = (places.col(static_cast<Index>(v)) - last).squaredNorm();
                distance[v] = std::min(distance[v], d);
                sum += static_cast<double>(distance[v]);
            }
            sums[begin / kGrain] = sum;
        });
        double total = 0.0;
        for (const double sum : sums) total += sum;
        if (!(total > 0.0)) break;
        const uint32_t next = find(distance, sums, random.uniform() * total);
        if (!(distance[next] > 0.0f)) break;
        chosen.push_back(next);
    }
    return chosen;
}

}  // namespace paim
