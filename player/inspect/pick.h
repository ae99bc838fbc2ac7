// Which triangle, and which vertex, a ray meets first.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "paim/mesh/topology.h"
#include "paim/shade/camera.h"

namespace paim::player {

struct Ray {
    Vec3f origin;
    Vec3f direction;  // not zero; its length does not matter
};

// The ray of Camera::ray_direction().
// u, v  0 … 1 from the upper left corner of the picture
Ray ray_through_pixel(const Camera& camera, float u, float v, float aspect);

// A part as it is decoded.
struct PickSurface {
    const Topology* topology;
    std::span<const float> positions;  // [3][V] x, y and z in the space of the ray
};

struct SurfaceHit {
    uint32_t part = 0;
    uint32_t triangle = 0;
    uint32_t vertex = 0;         // the nearest corner of the triangle
    Vec3f barycentric{0, 0, 0};  // of the corners, each 0 … 1
    double distance = 0.0;       // from the origin of the ray, in its unit of length
};

// The nearest hit in front of the ray's origin, on either side of a triangle. Of equally near ones it
// is that of the lowest part, then of the lowest triangle. Triangles without area and those with a
// corner that is not finite are not hit. On all threads, with the same result on any number.
// Based on: Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997
std::optional<SurfaceHit> pick(const Ray& ray, std::span<const PickSurface> parts);

}  // namespace paim::player
