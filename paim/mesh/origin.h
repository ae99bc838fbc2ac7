// Where the coordinates of a sequence are counted from, so that single precision is enough for
// them.
#pragma once

#include "paim/mesh/bounds.h"

namespace paim {

// A float has 24 significant bits, and every doubling of a mesh's distance from where its
// coordinates are counted from takes one of them from its shape. A mesh within 16 diagonals of the
// world's origin keeps 19 of them or more (a rounding of at most 2⁻²⁰ of its diagonal); this is
// left alone, and so ordinary files keep their coordinates. Beyond that coordinates are counted
// from near the mesh's own centre.
// bounds   of every vertex that a face has, in all poses, scene units
// returns  zero if the centre is within 16 diagonals of it, or if the bounds have no size;
//          otherwise the centre, each coordinate rounded to a multiple of the largest power of two
//          that is not above the diagonal. So whole meshes moved by such multiples have the same
//          local coordinates, no local coordinate exceeds the diagonal, and the number is short.
Vec3d choose_origin(const BoundsD& bounds);

}  // namespace paim
