// Points of a mesh whose light is traced.
#include "analysis/reference/traced_mesh.h"

#include <algorithm>

namespace paim {

void TracedMesh::append(const TracedMesh& other) {
    albedo.append(other.albedo, topology.num_vertices, other.topology.num_vertices);
    topology.append(other.topology);
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
}

SurfacePoint surface_point(const TracedMesh& mesh, std::span<const float> offsets,
                           const TracedPoint& point) {
    const Triangle& t = mesh.topology.triangles[point.triangle];
    const float w = 1.0f - point.u - point.v;
    const auto blend = [&](const std::vector<Vec3f>& values) -> Vec3f {
        return w * values[t[0]] + point.u * values[t[1]] + point.v * values[t[2]];
    };
    const Vec3f normal = blend(mesh.normals);
    const float length = normal.norm();
    if (!(length > 0.0f)) return {blend(mesh.positions), Vec3f::Zero()};
    const Vec3d a = mesh.positions[t[0]].cast<double>();
    Vec3d off = (mesh.positions[t[1]].cast<double>() - a)
                    .cross(mesh.positions[t[2]].cast<double>() - a)
                    .normalized();
    if (off.dot(normal.cast<double>()) < 0.0) off = -off;
    const float distance = std::max({offsets[t[0]], offsets[t[1]], offsets[t[2]]});
    const Vec3d origin = blend(mesh.positions).cast<double>() + static_cast<double>(distance) * off;
    return {origin.cast<float>(), normal / length};
}

}  // namespace paim
