// A grid of triangles and a smooth surface over it.
#pragma once

#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A grid of so many vertices in each direction, two triangles a cell.
inline Topology make_grid(uint32_t width) {
    Topology grid{width * width, {}};
    for (uint32_t y = 0; y + 1 < width; ++y) {
        for (uint32_t x = 0; x + 1 < width; ++x) {
            const uint32_t v = y * width + x;
            grid.triangles.push_back({v, v + 1, v + width});
            grid.triangles.push_back({v + 1, v + width + 1, v + width});
        }
    }
    return grid;
}

// Heights of a paraboloid over the grid, 0 to about 10.
inline std::vector<float> paraboloid(uint32_t width) {
    std::vector<float> values;
    for (uint32_t v = 0; v < width * width; ++v) {
        const float x = static_cast<float>(v % width) / static_cast<float>(width) - 0.4f;
        const float y = static_cast<float>(v / width) / static_cast<float>(width) - 0.3f;
        values.push_back(20.0f * (x * x + 0.7f * y * y - 0.3f * x * y));
    }
    return values;
}

}  // namespace paim
