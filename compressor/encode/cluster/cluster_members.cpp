// The points of each cluster.
#include "compressor/encode/cluster/cluster_members.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

using Eigen::Index;

namespace {

// The member that is farthest from a place; the first of equals.
uint32_t farthest(const Eigen::MatrixXf& points, const std::vector<uint32_t>& members,
                  const Eigen::VectorXf& from) {
    uint32_t best = members[0];
    float best_distance = -1.0f;
    for (const uint32_t v : members) {
        const float distance = (points.col(static_cast<Index>(v)) - from).squaredNorm();
        if (distance > best_distance) {
            best = v;
            best_distance = distance;
        }
    }
    return best;
}

// The members nearer to the one farthest from the mean than to the one farthest from that. Empty if
// all are equal.
std::vector<uint32_t> half_of(const Eigen::MatrixXf& points, const std::vector<uint32_t>& members) {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(points.rows());
    for (const uint32_t v : members) mean += points.col(static_cast<Index>(v)).cast<double>();
    mean /= static_cast<double>(members.size());
    const Eigen::VectorXf one =
        points.col(static_cast<Index>(farthest(points, members, mean.cast<float>())));
    const Eigen::VectorXf other = points.col(static_cast<Index>(farthest(points, members, one)));
    std::vector<uint32_t> half;
    for (const uint32_t v : members) {
        const auto x = points.col(static_cast<Index>(v));
        if ((x - one).squaredNorm() < (x - other).squaredNorm()) half.push_back(v);
    }
    return half;
}

}  // namespace

ClusterMembers::ClusterMembers(const std::vector<uint32_t>& cluster, uint32_t num_clusters)
    : first_(size_t{num_clusters} + 1, 0), member_(cluster.size()) {
    for (const uint32_t c : cluster) {
        PAIM_CHECK_LT(c, num_clusters);
        ++first_[c + 1];
    }
    for (size_t c = 0; c < num_clusters; ++c) first_[c + 1] += first_[c];
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (uint32_t v = 0; v < cluster.size(); ++v) member_[next[cluster[v]]++] = v;
}

uint32_t fill_empty_clusters(const Eigen::MatrixXf& points,
                             const std::vector<float>& squared_distance, uint32_t num_clusters,
                             std::vector<uint32_t>& cluster) {
    std::vector<double> error(num_clusters, 0.0);
    std::vector<uint32_t> size(num_clusters, 0);
    for (size_t v = 0; v < cluster.size(); ++v) {
        error[cluster[v]] += static_cast<double>(squared_distance[v]);
        ++size[cluster[v]];
    }
    auto num_empty = static_cast<uint32_t>(std::count(size.begin(), size.end(), 0u));
    for (uint32_t empty = 0; empty < num_clusters && num_empty > 0; ++empty) {
        while (size[empty] == 0) {
            const auto worst =
                static_cast<uint32_t>(std::max_element(error.begin(), error.end()) - error.begin());
            if (!(error[worst] > 0.0)) return num_empty;
            std::vector<uint32_t> members;
            for (uint32_t v = 0; v < cluster.size(); ++v) {
                if (cluster[v] == worst) members.push_back(v);
            }
            const std::vector<uint32_t> half = half_of(points, members);
            if (half.empty()) {
                error[worst] = 0.0;  // equal points: not to be split
                continue;
            }
            for (const uint32_t v : half) cluster[v] = empty;
            size[empty] = static_cast<uint32_t>(half.size());
            size[worst] -= size[empty];
            --num_empty;
            // The errors of the two halves are not known yet: assume that together they are half as
            // large, and that each has its share by its number of points.
            const double per_point = 0.5 * error[worst] / static_cast<double>(members.size());
            error[empty] = per_point * size[empty];
            error[worst] = per_point * size[worst];
        }
    }
    return num_empty;
}

uint32_t drop_empty_clusters(uint32_t num_clusters, std::vector<uint32_t>& cluster) {
    std::vector<uint32_t> number(num_clusters, 0);
    for (const uint32_t c : cluster) number[c] = 1;
    uint32_t count = 0;
    for (uint32_t& n : number) {
        const uint32_t used = n;
        n = count;
        count += used;
    }
    for (uint32_t& c : cluster) c = number[c];
    return count;
}

}  // namespace paim
