// Chooses the origin of the coordinates of a sequence, so that single precision is enough for them.
#pragma once

#include "paim/mesh/bounds.h"

namespace paim {

// The most that rounding moves a coordinate of a mesh, relative to its diagonal (below).
constexpr double kCoordinateRounding = 0x1p-20;

// A float has 24 significant bits. Every doubling of a mesh's distance from the origin takes one of
// them from its shape. A mesh within 16 diagonals of the world's origin keeps at least 19 bits (a
// rounding of at most 2⁻²⁰ of its diagonal), so its coordinates stay as they are. Coordinates of a
// mesh farther away are taken relative to a point near its centre.
// bounds   of all vertices of faces in all poses, scene units
// returns  zero if the centre is within 16 diagonals of the world's origin, or if the bounds have
//          no size; otherwise the centre, each coordinate rounded to a multiple of the largest
//          power of two that is not above the diagonal. So a mesh that is moved by such multiples
//          keeps its local coordinates, no local coordinate exceeds the diagonal, and the numbers
//          are short.
Vec3d choose_origin(const BoundsD& bounds);

}  // namespace paim
