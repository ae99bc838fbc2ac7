// Vertex normals from vn lines.
#include "compressor/io/obj_normals.h"

#include "paim/base/check.h"
#include "paim/mesh/normals.h"

namespace paim {

std::vector<Vec3f> obj_normals(const Topology& topology, const Polygons& faces,
                               const ParsedObj& parsed, std::span<const Vec3f> positions) {
    PAIM_CHECK_EQ(parsed.corner_normals.size(), faces.corners.size());
    // stableNormalized() neither underflows nor overflows, and returns zero for zero.
    std::vector<Vec3d> units(parsed.normals.size());
    for (size_t i = 0; i < units.size(); ++i) units[i] = parsed.normals[i].stableNormalized();

    std::vector<Vec3d> sums(topology.num_vertices, Vec3d::Zero());
    for (size_t i = 0; i < faces.corners.size(); ++i) {
        const int32_t normal = parsed.corner_normals[i];
        if (normal >= 0) sums[faces.corners[i]] += units[static_cast<size_t>(normal)];
    }
    std::vector<Vec3f> normals(topology.num_vertices);
    std::vector<Vec3f> computed;  // computed only if needed
    for (size_t v = 0; v < normals.size(); ++v) {
        const double length = sums[v].norm();
        // Opposite normals cancel; the remaining sum is rounding, and its direction means nothing.
        if (length >= 1e-9) {
            normals[v] = (sums[v] / length).cast<float>();
            continue;
        }
        if (computed.empty()) computed = vertex_normals(topology, positions);
        normals[v] = computed[v];
    }
    return normals;
}

}  // namespace paim
