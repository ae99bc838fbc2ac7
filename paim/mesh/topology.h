// What all poses of a sequence share: the triangles and the albedo.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

using Triangle = std::array<uint32_t, 3>;

struct Topology {
    uint32_t num_vertices = 0;
    std::vector<Triangle> triangles;  // [F], indices < num_vertices, counter-clockwise from outside

    bool operator==(const Topology&) const = default;
};

// Diffuse reflectance, linear, 0..1 per channel: one value for the whole mesh or one per vertex.
struct Albedo {
    std::vector<Vec3f> values{Vec3f::Constant(0.8f)};  // [1] or [V]

    const Vec3f& at(uint32_t v) const { return values.size() == 1 ? values[0] : values[v]; }
};

}  // namespace paim
