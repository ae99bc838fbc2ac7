// Polygons to triangles, once for all poses.
// Based on: G. H. Meisters, Polygons Have Ears, 1975
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/io/polygons.h"
#include "paim/mesh/topology.h"

namespace paim {

struct Triangulation {
    std::vector<Triangle> triangles;  // polygon by polygon, winding kept
    // Polygons that name a vertex twice. Corners that repeat their neighbour are merged first;
    // triangles that still name one twice are dropped.
    uint64_t num_repeating = 0;
    // Polygons without area, or that cross themselves: split like a fan where nothing better is
    // left.
    uint64_t num_degenerate = 0;
};

// Quads are cut along the diagonal that leaves both triangles facing with the quad, of two such
// diagonals the shorter, of two equally long ones (to 1e-5, what six printed digits leave) that at
// the first corner. Larger polygons are cut by ear clipping in the plane of their Newell normal.
// positions  [V] scene units, finite
Triangulation triangulate(const Polygons& polygons, std::span<const Vec3f> positions);

}  // namespace paim
