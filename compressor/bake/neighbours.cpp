// The vertices that share a face with each vertex.
#include "compressor/bake/neighbours.h"

#include <algorithm>
#include <utility>

namespace paim {

Neighbours::Neighbours(const Topology& topology) {
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    pairs.reserve(6 * topology.triangles.size());
    for (const Triangle& t : topology.triangles) {
        for (size_t corner = 0; corner < 3; ++corner) {
            for (const uint32_t neighbour : {t[(corner + 1) % 3], t[(corner + 2) % 3]}) {
                if (neighbour != t[corner]) pairs.emplace_back(t[corner], neighbour);
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    all_.reserve(pairs.size());
    begin_.assign(topology.num_vertices + size_t{1}, 0);
    for (const auto& [v, neighbour] : pairs) {
        ++begin_[v + size_t{1}];
        all_.push_back(neighbour);
    }
    for (size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
}

double open_fraction_around(const Neighbours& neighbours, size_t v,
                            std::span<const uint64_t> num_rays,
                            std::span<const uint64_t> num_occluded) {
    double sum = 0.0;
    size_t count = 0;
    for (const uint32_t neighbour : neighbours[v]) {
        if (num_rays[neighbour] == 0) continue;
        sum += static_cast<double>(num_rays[neighbour] - num_occluded[neighbour]) /
               static_cast<double>(num_rays[neighbour]);
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

}  // namespace paim
