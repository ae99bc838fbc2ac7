// Texture coordinates of the corners of triangles that polygons were cut into.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/io/polygons.h"
#include "paim/mesh/topology.h"

namespace paim {

// Finds corners of polygons by their vertices.
class CornerFinder {
  public:
    explicit CornerFinder(const Polygons& polygons);

    // The corners of a triangle of a polygon: indices into Polygons::corners. Of corners with the
    // same vertex it is the first.
    Triangle find(uint32_t polygon, const Triangle& vertices);

  private:
    struct Corner {
        uint32_t vertex, index;
    };

    const Polygons& polygons_;
    std::vector<uint32_t> first_corner_;  // of each polygon
    uint32_t sorted_polygon_;             // whose corners are sorted
    std::vector<Corner> sorted_;          // by vertex, then by index
};

}  // namespace paim
