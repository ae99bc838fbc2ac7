// Vertex normals as averages of face normals, weighted by angle.
// Based on: Thürmer and Wüthrich, Computing Vertex Normals from Polygonal Facets, 1998
#include "paim/mesh/normals.h"

#include <algorithm>
#include <cmath>

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

std::array<double, 3> corner_angles(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    // Squares of floats neither underflow nor overflow in double. normalized() leaves zero alone.
    const Vec3d ab = (b.cast<double>() - a.cast<double>()).normalized();
    const Vec3d bc = (c.cast<double>() - b.cast<double>()).normalized();
    const Vec3d ca = (a.cast<double>() - c.cast<double>()).normalized();
    // Exact at all angles: the sine is where the cosine is flat, and the other way round.
    const auto turn = [](const Vec3d& in, const Vec3d& out) {
        return std::atan2(in.cross(out).norm(), -in.dot(out));
    };
    return {turn(ca, ab), turn(ab, bc), turn(bc, ca)};
}

std::vector<Vec3f> vertex_normals(const Topology& topology, std::span<const Vec3f> positions,
                                  std::span<const uint32_t> seams) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    if (!seams.empty()) PAIM_CHECK_EQ(seams.size(), positions.size());
    // The weight of a corner whose angle rounds to 0. It counts where all corners are such ones.
    constexpr double kSmallestWeight = 1e-100;
    struct Sum {
        Vec3d normals = Vec3d::Zero();
        double weights = 0.0;
    };
    std::vector<Sum> sums(positions.size());
    for (const Triangle& t : topology.triangles) {
        const Vec3d normal = face_normal(positions[t[0]], positions[t[1]], positions[t[2]]);
        if (normal.isZero(0.0)) continue;
        const std::array<double, 3> angles =
            corner_angles(positions[t[0]], positions[t[1]], positions[t[2]]);
        for (size_t corner = 0; corner < 3; ++corner) {
            const double weight = std::max(angles[corner], kSmallestWeight);
            Sum& sum = sums[seams.empty() ? t[corner] : seams[t[corner]]];
            sum.normals += weight * normal;
            sum.weights += weight;
        }
    }
    std::vector<Vec3f> normals(positions.size());
    for (size_t v = 0; v < normals.size(); ++v) {
        const Sum& sum = sums[seams.empty() ? v : seams[v]];
        const double length = sum.normals.norm();
        // Opposite faces cancel; the remaining sum is rounding, and its direction means nothing.
        const bool cancels = !(length >= 1e-9 * sum.weights) || sum.weights == 0.0;
        normals[v] = cancels ? Vec3f(Vec3f::Zero()) : Vec3f((sum.normals / length).cast<float>());
    }
    return normals;
}

}  // namespace paim
