// Two unit vectors that make a right-handed basis with a unit vector.
// Based on: Duff, Burgess, Christensen, Hery, Kensler, Liani and Villemin, Building an Orthonormal
//           Basis, Revisited, JCGT 6(1), 2017
#pragma once

#include <cmath>

#include "paim/base/vector.h"

namespace paim {

// normal  unit; float or double
template <typename Vector>
void orthonormal_basis(const Vector& normal, Vector& tangent, Vector& bitangent) {
    using Scalar = typename Vector::Scalar;
    const Scalar one(1);
    const Scalar sign = std::copysign(one, normal.z());
    const Scalar a = -one / (sign + normal.z());
    const Scalar b = normal.x() * normal.y() * a;
    tangent = Vector(one + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
    bitangent = Vector(b, sign + normal.y() * normal.y() * a, -normal.y());
}

}  // namespace paim
