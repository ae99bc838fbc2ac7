// Bounds of a pose that single vertices far from all others do not move.
#pragma once

#include <cstdint>
#include <span>

#include "paim/mesh/bounds.h"

namespace paim {

struct UsualBounds {
    // Of the faces, or, where single vertices are far from all others, the middle.
    BoundsD bounds;
    // The middle 90 % of the corners along each axis. Empty if there are fewer than 40.
    BoundsD middle;
    Vec3d median = Vec3d::Zero();  // axis by axis
};

// positions  [V] scene units, finite where a face has the vertex
// corners    the vertices of faces, one entry for each corner; at most some 4000 are looked at
// bounds     of all of them
UsualBounds usual_bounds(std::span<const Vec3d> positions, std::span<const uint32_t> corners,
                         const BoundsD& bounds);

}  // namespace paim
