// A mesh whose light is traced, and the points of its triangles where rays start.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A mesh in the coordinates of the scene. Without vertices: there is none.
struct TracedMesh {
    Topology topology;
    Albedo albedo;
    std::vector<Vec3f> positions;  // [V]
    std::vector<Vec3f> normals;    // [V] unit, or zero: no light is reflected

    // Adds the other's vertices and triangles after the existing ones.
    void append(const TracedMesh& other);
};

// A point of a triangle.
struct TracedPoint {
    uint32_t triangle;
    float u, v;  // barycentric weights of its second and third vertex
};

// Where rays from a point of a triangle start, and its normal.
struct SurfacePoint {
    Vec3f origin;  // off the triangle, on the side of the normal
    Vec3f normal;  // interpolated, unit; zero where the corners have none
};

// offsets  [V] of the mesh (ray_offsets()); the largest of the corners is taken
SurfacePoint surface_point(const TracedMesh& mesh, std::span<const float> offsets,
                           const TracedPoint& point);

}  // namespace paim
