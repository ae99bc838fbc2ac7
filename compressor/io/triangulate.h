// Triangulates polygons, once for all poses.
// Based on: G. H. Meisters, Polygons Have Ears, 1975
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/io/polygons.h"
#include "paim/mesh/topology.h"

namespace paim {

struct Triangulation {
    std::vector<Triangle> triangles;  // in the order of the polygons, with their winding
    // Polygons that name a vertex twice. Corners that repeat their neighbour are merged first;
    // triangles that still name one twice are dropped.
    uint64_t num_repeating = 0;
    // Polygons that have no area or cross themselves. They are split like a fan if ear clipping
    // fails.
    uint64_t num_degenerate = 0;
};

// Quads are cut along the diagonal for which both triangles face like the quad. If both diagonals
// do, the shorter one is taken; of two equally long ones (to 1e-5, the precision of six printed
// digits) that at the first corner. Larger polygons are cut by ear clipping in the plane of their
// Newell normal.
// positions  [V] scene units, finite
Triangulation triangulate(const Polygons& polygons, std::span<const Vec3f> positions);

}  // namespace paim
