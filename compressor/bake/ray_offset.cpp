// Distance of the start of shadow rays from the surface.
#include "compressor/bake/ray_offset.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/mesh/normals.h"

namespace paim {

std::vector<VertexFaces> measure_vertex_faces(const Topology& topology,
                                              std::span<const Vec3f> positions,
                                              std::span<const Vec3f> normals) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    std::vector<VertexFaces> vertices(positions.size());
    for (const Triangle& t : topology.triangles) {
        // Faces without area cannot be hit, and do not show the size of details of the surface.
        const Vec3d normal = face_normal(positions[t[0]], positions[t[1]], positions[t[2]]);
        if (normal.isZero(0.0)) continue;
        // The place where a ray crosses a face depends on all three corners.
        float coordinate = 0.0f;
        for (const uint32_t v : t) {
            coordinate = std::max(coordinate, positions[v].cwiseAbs().maxCoeff());
        }
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t a = t[corner];
            const uint32_t b = t[(corner + 1) % 3];
            const double length =
                (positions[a].cast<double>() - positions[b].cast<double>()).stableNorm();
            for (const uint32_t v : {a, b}) {
                vertices[v].shortest = std::min(vertices[v].shortest, length);
            }
            VertexFaces& vertex = vertices[a];
            vertex.largest = std::max(vertex.largest, coordinate);
            if (normals.empty()) continue;
            const double cosine = normal.dot(normals[a].cast<double>());
            vertex.lowest_cosine = std::min(vertex.lowest_cosine, cosine);
            vertex.highest_cosine = std::max(vertex.highest_cosine, cosine);
        }
    }
    return vertices;
}

std::vector<float> ray_offsets(const Topology& topology, std::span<const Vec3f> positions,
                               const RayOffsetRule& rule) {
    const std::vector<VertexFaces> vertices = measure_vertex_faces(topology, positions, {});
    std::vector<float> offsets(positions.size(), 0.0f);
    for (size_t v = 0; v < positions.size(); ++v) {
        if (!vertices[v].any()) continue;
        offsets[v] = static_cast<float>(std::max(rule.of_edge * vertices[v].shortest,
                                                 rule.of_coordinate * vertices[v].rounding()));
    }
    return offsets;
}

}  // namespace paim
