// How often triangles are drawn if a draw has the bases of some clusters alone.
// Based on: Sloan, Hall, Hart and Snyder 2003; Chen 2005 (see the header)
#include "analysis/study/cluster/overdraw.h"

#include <algorithm>
#include <array>

namespace paim::study {

namespace {

// Different groups of three.
uint32_t num_different(uint32_t a, uint32_t b, uint32_t c) {
    return 1u + (b != a) + (c != a && c != b);
}

// Pairs of groups and the number of triangles that have vertices of both.
class CommonTriangles {
  public:
    CommonTriangles(const Topology& topology, std::span<const uint32_t> cluster, uint32_t count)
        : count_(count) {
        for (const Triangle& t : topology.triangles) {
            groups_.push_back({cluster[t[0]], cluster[t[1]], cluster[t[2]]});
        }
    }

    // [groups][groups], symmetric, 0 on the diagonal
    std::vector<uint32_t> counts() const {
        std::vector<uint32_t> common(size_t{count_} * count_, 0);
        for (const auto& [a, b, c] : groups_) {
            const auto add = [&](uint32_t x, uint32_t y) {
                ++common[size_t{x} * count_ + y];
                ++common[size_t{y} * count_ + x];
            };
            if (a != b) add(a, b);
            if (c != a && c != b) add(a, c);
            if (c != a && c != b && a != b) add(b, c);
        }
        return common;
    }

    void merge(uint32_t from, uint32_t into) {
        for (auto& groups : groups_) std::replace(groups.begin(), groups.end(), from, into);
    }

  private:
    size_t count_;
    std::vector<std::array<uint32_t, 3>> groups_;  // of the vertices of each triangle
};

}  // namespace

double overdraw(const Topology& topology, std::span<const uint32_t> group) {
    uint64_t draws = 0;
    for (const Triangle& t : topology.triangles) {
        draws += num_different(group[t[0]], group[t[1]], group[t[2]]);
    }
    return static_cast<double>(draws) / static_cast<double>(topology.triangles.size());
}

std::vector<uint32_t> super_clusters(const Topology& topology, std::span<const uint32_t> cluster,
                                     uint32_t num_clusters, uint32_t most_clusters) {
    CommonTriangles triangles(topology, cluster, num_clusters);
    std::vector<uint32_t> group(num_clusters), size(num_clusters, 1);
    for (uint32_t c = 0; c < num_clusters; ++c) group[c] = c;
    for (;;) {
        const std::vector<uint32_t> common = triangles.counts();
        uint32_t best = 0, into = 0, from = 0;
        for (uint32_t a = 0; a < num_clusters; ++a) {
            for (uint32_t b = a + 1; b < num_clusters; ++b) {
                const uint32_t count = common[size_t{a} * num_clusters + b];
                if (count <= best || size[a] + size[b] > most_clusters) continue;
                best = count;
                into = a;
                from = b;
            }
        }
        if (best == 0) break;
        triangles.merge(from, into);
        std::replace(group.begin(), group.end(), from, into);
        size[into] += size[from];
    }
    std::vector<uint32_t> number(num_clusters, 0);
    uint32_t count = 0;
    for (uint32_t c = 0; c < num_clusters; ++c) {
        if (group[c] == c) number[c] = count++;
    }
    for (uint32_t& g : group) g = number[g];
    return group;
}

namespace {

// Vertices that move between clusters.
class Movers {
  public:
    Movers(const Topology& topology, std::vector<uint32_t>& cluster)
        : topology_(topology), cluster_(cluster), triangles_(cluster.size()) {
        for (uint32_t f = 0; f < topology.triangles.size(); ++f) {
            for (const uint32_t v : topology.triangles[f]) {
                auto& of_vertex = triangles_[v];
                if (of_vertex.empty() || of_vertex.back() != f) of_vertex.push_back(f);
            }
        }
        for (const uint32_t c : cluster) {
            if (c >= size_.size()) size_.resize(size_t{c} + 1, 0);
            ++size_[c];
        }
    }

    bool may_leave(uint32_t v) const { return size_[cluster_[v]] > 1; }

    void move(uint32_t v, uint32_t c) {
        --size_[cluster_[v]];
        ++size_[c];
        cluster_[v] = c;
    }

    // Clusters of the vertices that share a triangle with v, ascending, without its own.
    void clusters_around(uint32_t v, std::vector<uint32_t>& around) const {
        around.clear();
        for (const uint32_t f : triangles_[v]) {
            for (const uint32_t w : topology_.triangles[f]) {
                if (cluster_[w] != cluster_[v]) around.push_back(cluster_[w]);
            }
        }
        std::sort(around.begin(), around.end());
        around.erase(std::unique(around.begin(), around.end()), around.end());
    }

    // How often the triangles of v are drawn if it is in cluster c.
    uint32_t draws(uint32_t v, uint32_t c) const {
        uint32_t sum = 0;
        for (const uint32_t f : triangles_[v]) {
            const Triangle& t = topology_.triangles[f];
            const auto of = [&](size_t j) { return t[j] == v ? c : cluster_[t[j]]; };
            sum += num_different(of(0), of(1), of(2));
        }
        return sum;
    }

  private:
    const Topology& topology_;
    std::vector<uint32_t>& cluster_;
    std::vector<std::vector<uint32_t>> triangles_;  // [V] of each vertex
    std::vector<uint32_t> size_;                    // [clusters]
};

}  // namespace

uint32_t make_coherent(const Topology& topology, const VertexErrors& squared_error, double alpha,
                       std::vector<uint32_t>& cluster) {
    Movers movers(topology, cluster);
    std::vector<double> most(cluster.size());
    for (uint32_t v = 0; v < cluster.size(); ++v) {
        most[v] = (1.0 + alpha) * squared_error(v, cluster[v]);
    }
    std::vector<uint32_t> around;
    uint32_t moves = 0, before = 0;
    do {
        before = moves;
        for (uint32_t v = 0; v < cluster.size(); ++v) {
            movers.clusters_around(v, around);
            if (around.empty() || !movers.may_leave(v)) continue;
            const uint32_t now = movers.draws(v, cluster[v]);
            uint32_t fewest = now, best = cluster[v];
            double best_error = 0.0;
            for (const uint32_t c : around) {
                const uint32_t draws = movers.draws(v, c);
                if (draws > fewest || draws == now) continue;
                const double error = squared_error(v, c);
                if (error >= most[v] || (draws == fewest && error >= best_error)) continue;
                fewest = draws;
                best = c;
                best_error = error;
            }
            if (best == cluster[v]) continue;
            movers.move(v, best);
            ++moves;
        }
    } while (moves != before);
    return moves;
}

}  // namespace paim::study
