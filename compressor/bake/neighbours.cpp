// The vertices that share a face with each vertex.
#include "compressor/bake/neighbours.h"

#include <algorithm>

namespace paim {

Neighbours::Neighbours(const Topology& topology) {
    // First with those of every face, which are there twice along inner edges.
    std::vector<size_t> begin(topology.num_vertices + size_t{1}, 0);
    for (const Triangle& t : topology.triangles) {
        for (const uint32_t v : t) begin[v + size_t{1}] += 2;
    }
    for (size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::vector<uint32_t> of_faces(begin.back());
    std::vector<size_t> next(begin.begin(), begin.end() - 1);
    for (const Triangle& t : topology.triangles) {
        for (size_t corner = 0; corner < 3; ++corner) {
            of_faces[next[t[corner]]++] = t[(corner + 1) % 3];
            of_faces[next[t[corner]]++] = t[(corner + 2) % 3];
        }
    }
    begin_.assign(begin.size(), 0);
    all_.reserve(of_faces.size() / 2);
    for (size_t v = 0; v + 1 < begin.size(); ++v) {
        const std::span<uint32_t> these(of_faces.data() + begin[v], begin[v + 1] - begin[v]);
        std::sort(these.begin(), these.end());
        for (size_t k = 0; k < these.size(); ++k) {
            if (these[k] != v && (k == 0 || these[k] != these[k - 1])) all_.push_back(these[k]);
        }
        begin_[v + 1] = all_.size();
    }
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
