// Vertex normals as the average of face normals.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry, 2012
#include "paim/mesh/normals.h"

#include <algorithm>

#include "paim/base/check.h"

namespace paim {

Vec3d face_normal(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    Vec3d ab = b.cast<double>() - a.cast<double>();
    Vec3d ac = c.cast<double>() - a.cast<double>();
    // Scaling by the largest entry avoids underflow in tiny meshes and overflow in huge ones.
    const double scale = std::max(ab.cwiseAbs().maxCoeff(), ac.cwiseAbs().maxCoeff());
    if (!(scale > 0.0)) return Vec3d::Zero();
    ab /= scale;
    ac /= scale;
    const Vec3d normal = ab.cross(ac);
    const double length = normal.norm();
    // The cross product of parallel edges is only rounding, a few 2^-53.
    if (length <= 1e-15) return Vec3d::Zero();
    return normal / length;
}

std::vector<Vec3f> vertex_normals(const Topology& topology, std::span<const Vec3f> positions) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    std::vector<Vec3d> sums(positions.size(), Vec3d::Zero());
    for (const Triangle& t : topology.triangles) {
        const Vec3d normal = face_normal(positions[t[0]], positions[t[1]], positions[t[2]]);
        for (const uint32_t v : t) sums[v] += normal;
    }
    std::vector<Vec3f> normals(positions.size());
    std::transform(sums.begin(), sums.end(), normals.begin(), [](const Vec3d& sum) -> Vec3f {
        const double length = sum.norm();
        // Opposite faces cancel; the remaining sum is rounding, and its direction means nothing.
        if (length < 1e-9) return Vec3f::Zero();
        return (sum / length).cast<float>();
    });
    return normals;
}

}  // namespace paim
