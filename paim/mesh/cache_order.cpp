// Vertices and triangles in an order in which neighbours are close together.
#include "paim/mesh/cache_order.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace paim {

CacheOrder cache_order(const Topology& topology) {
    CacheOrder order;
    order.topology.num_vertices = topology.num_vertices;
    order.old_vertex.reserve(topology.num_vertices);
    if (topology.triangles.empty()) {
        order.old_vertex.resize(topology.num_vertices);
        std::iota(order.old_vertex.begin(), order.old_vertex.end(), 0u);
        return order;
    }
    static_assert(sizeof(Triangle) == 3 * sizeof(uint32_t));
    const auto* indices = reinterpret_cast<const uint32_t*>(topology.triangles.data());
    const size_t num_indices = 3 * topology.triangles.size();
    order.topology.triangles.resize(topology.triangles.size());
    auto* ordered = reinterpret_cast<uint32_t*>(order.topology.triangles.data());
    meshopt_optimizeVertexCache(ordered, indices, num_indices, topology.num_vertices);

    // Vertices in the order in which triangles name them first.
    constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> new_vertex(topology.num_vertices, kNone);
    const auto number = [&](uint32_t old) {
        if (new_vertex[old] == kNone) {
            new_vertex[old] = static_cast<uint32_t>(order.old_vertex.size());
            order.old_vertex.push_back(old);
        }
        return new_vertex[old];
    };
    for (size_t i = 0; i < num_indices; ++i) ordered[i] = number(ordered[i]);
    for (uint32_t v = 0; v < topology.num_vertices; ++v) number(v);
    return order;
}

uint32_t new_number_of_first(uint32_t first, const std::vector<uint32_t>& old_vertex) {
    const auto found = std::find_if(old_vertex.begin(), old_vertex.end(),
                                    [&](uint32_t old) { return old >= first; });
    if (found == old_vertex.end()) return kAllVertices;
    return static_cast<uint32_t>(found - old_vertex.begin());
}

}  // namespace paim
