// The triangles and the albedo, which all poses of a sequence share.
#pragma once

#include <algorithm>
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

    // Adds the other's vertices and triangles after the existing ones. The sum of both vertex
    // counts fits into 32 bits.
    void append(const Topology& other) {
        triangles.reserve(triangles.size() + other.triangles.size());
        for (const Triangle& t : other.triangles) {
            triangles.push_back({t[0] + num_vertices, t[1] + num_vertices, t[2] + num_vertices});
        }
        num_vertices += other.num_vertices;
    }

    // How many triangles, from the first, have no vertex of number `end` or above.
    size_t num_triangles_before(uint32_t end) const {
        const auto is_before = [&](const Triangle& t) {
            return std::max({t[0], t[1], t[2]}) < end;
        };
        const auto last = std::find_if_not(triangles.begin(), triangles.end(), is_before);
        return static_cast<size_t>(last - triangles.begin());
    }
};

// Diffuse reflectance, linear, 0..1 per channel: one value for the whole mesh or one per vertex.
struct Albedo {
    std::vector<Vec3f> values{Vec3f::Constant(0.8f)};  // [1] or [V]

    const Vec3f& at(uint32_t v) const { return values.size() == 1 ? values[0] : values[v]; }

    // Adds the albedo of `num_other` vertices of the other after that of `num_own` vertices of
    // this. The result stays one value if both have one, and the same.
    void append(const Albedo& other, uint32_t num_own, uint32_t num_other) {
        if (values.size() == 1 && other.values.size() == 1 && values[0] == other.values[0]) return;
        if (values.size() == 1) values.assign(num_own, Vec3f(values[0]));
        for (uint32_t v = 0; v < num_other; ++v) values.push_back(other.at(v));
    }
};

}  // namespace paim
