// One of the three ways to write the same triangle.
#pragma once

#include <cstddef>

#include "paim/mesh/topology.h"

namespace paim {

// The triangle with its corners from number `first` on, in the same turn.
inline Triangle from_corner(const Triangle& t, size_t first) {
    return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

// The corner to begin with, so that all rotations of a triangle are written alike: that of the
// lowest vertex. (Of the three ways it is the one that comes first, which also tells rotations of a
// triangle apart that has a vertex twice.)
inline size_t lowest_corner(const Triangle& t) {
    size_t lowest = 0;
    for (size_t first = 1; first < 3; ++first) {
        if (from_corner(t, first) < from_corner(t, lowest)) lowest = first;
    }
    return lowest;
}

}  // namespace paim
