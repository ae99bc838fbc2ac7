// Faces of files: polygons of any size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace paim {

struct Polygons {
    std::vector<uint32_t> sizes;    // [faces] corners of each, 3 or more
    std::vector<uint32_t> corners;  // [sum of sizes] vertex indices from 0

    size_t num_faces() const { return sizes.size(); }
    bool operator==(const Polygons&) const = default;
};

}  // namespace paim
