// The material of each vertex, from the materials of its faces.
#include "compressor/io/vertex_materials.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/mesh/normals.h"

namespace paim {

namespace {

constexpr double kRoundingRad = 1e-6;

// One corner of a face.
struct Corner {
    uint16_t material;
    double angle_rad;
};

struct MaterialSum {
    uint16_t material;
    double angle_rad;
};

// The material of the vertex with these corners, which are in the order of the faces.
// sums  scratch memory
uint16_t largest(std::span<const Corner> corners, std::vector<MaterialSum>& sums) {
    sums.clear();
    for (const Corner& corner : corners) {
        const auto known = std::find_if(sums.begin(), sums.end(), [&](const MaterialSum& sum) {
            return sum.material == corner.material;
        });
        if (known != sums.end()) {
            known->angle_rad += corner.angle_rad;
        } else {
            sums.push_back({corner.material, corner.angle_rad});
        }
    }
    if (sums.empty()) return 0;
    const MaterialSum* best = &sums.front();
    for (const MaterialSum& sum : sums) {
        if (sum.angle_rad > best->angle_rad + kRoundingRad) best = &sum;
    }
    return best->material;
}

}  // namespace

std::vector<uint16_t> materials_of_vertices(const Topology& topology,
                                            std::span<const Vec3f> positions,
                                            std::span<const uint16_t> of_face) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    PAIM_CHECK_EQ(of_face.size(), topology.triangles.size());
    const bool uniform = std::all_of(of_face.begin(), of_face.end(),
                                     [&](uint16_t material) { return material == of_face[0]; });
    if (uniform) return {of_face.empty() ? uint16_t{0} : of_face[0]};

    // The corners of each vertex, in the order of the faces.
    std::vector<uint32_t> first(topology.num_vertices + size_t{1}, 0);
    for (const Triangle& t : topology.triangles) {
        for (const uint32_t v : t) ++first[v + 1];
    }
    for (size_t v = 0; v < topology.num_vertices; ++v) first[v + 1] += first[v];
    std::vector<uint32_t> next(first.begin(), first.end() - 1);
    std::vector<Corner> corners(3 * topology.triangles.size());
    for (size_t f = 0; f < of_face.size(); ++f) {
        const Triangle& t = topology.triangles[f];
        const auto angles = corner_angles(positions[t[0]], positions[t[1]], positions[t[2]]);
        for (size_t corner = 0; corner < 3; ++corner) {
            corners[next[t[corner]]++] = {of_face[f], angles[corner]};
        }
    }
    std::vector<uint16_t> materials(topology.num_vertices);
    std::vector<MaterialSum> sums;
    for (size_t v = 0; v < materials.size(); ++v) {
        materials[v] = largest(std::span(corners).subspan(first[v], first[v + 1] - first[v]), sums);
    }
    return materials;
}

}  // namespace paim
