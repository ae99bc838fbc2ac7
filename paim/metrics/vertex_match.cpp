// Matches vertices and planes of a file with those of its bake.
#include "paim/metrics/vertex_match.h"

#include <algorithm>
#include <numeric>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/mesh/cache_order.h"

namespace paim {

namespace {

CacheOrder vertex_order(VertexOrder order, const Topology& of_bake) {
    if (order == VertexOrder::cache) return cache_order(of_bake);
    CacheOrder as_baked{{}, of_bake};
    as_baked.old_vertex.resize(of_bake.num_vertices);
    std::iota(as_baked.old_vertex.begin(), as_baked.old_vertex.end(), 0u);
    return as_baked;
}

Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

// Whether the triangles are the same. Corners of a triangle may be rotated.
bool same_triangles(const Topology& a, const Topology& b, TriangleOrder order) {
    if (a.num_vertices != b.num_vertices || a.triangles.size() != b.triangles.size()) return false;
    const auto all_turned = [](const Topology& topology) {
        std::vector<Triangle> triangles(topology.triangles.size());
        std::transform(topology.triangles.begin(), topology.triangles.end(), triangles.begin(),
                       turned);
        return triangles;
    };
    std::vector<Triangle> of_a = all_turned(a), of_b = all_turned(b);
    if (of_a == of_b || order == TriangleOrder::same) return of_a == of_b;
    std::sort(of_a.begin(), of_a.end());
    std::sort(of_b.begin(), of_b.end());
    return of_a == of_b;
}

}  // namespace

std::vector<uint32_t> match_vertices(const Topology& of_file, VertexOrder order,
                                     const Topology& of_bake, const std::string& bake,
                                     const char* what, TriangleOrder triangles) {
    CacheOrder expected = vertex_order(order, of_bake);
    if (!same_triangles(of_file, expected.topology, triangles)) {
        throw_bad_input("{}: expected a file made from this bake, got other {}", bake, what);
    }
    return std::move(expected.old_vertex);
}

std::optional<uint32_t> plane_of_file(const TransferLayout& of_file, const TransferLayout& of_bake,
                                      uint32_t plane) {
    const uint32_t i = plane % of_bake.num_coefficients();
    const uint32_t outgoing = plane / of_bake.num_coefficients();  // of all channels
    const uint32_t channel = outgoing / of_bake.num_outgoing();
    const uint32_t o = outgoing % of_bake.num_outgoing();
    if (i >= of_file.num_coefficients() || o >= of_file.num_outgoing()) return std::nullopt;
    return of_file.plane(of_file.channels == 1 ? 0 : channel, i, o);
}

void reorder_planes(std::span<float> planes, std::span<const uint32_t> old_vertex) {
    if (old_vertex.empty()) return;
    PAIM_CHECK_EQ(planes.size() % old_vertex.size(), 0u);
    std::vector<float> old(old_vertex.size());
    for (size_t first = 0; first < planes.size(); first += old.size()) {
        const std::span<float> plane = planes.subspan(first, old.size());
        std::copy(plane.begin(), plane.end(), old.begin());
        for (size_t v = 0; v < old.size(); ++v) plane[v] = old[old_vertex[v]];
    }
}

}  // namespace paim
