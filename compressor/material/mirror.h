// Mirror reflection at a surface whose normal is z.
#pragma once

#include "paim/base/vector.h"

namespace paim {

// The direction that a mirror reflects light of `direction` to. Both point away from the surface.
inline Vec3d mirrored(const Vec3d& direction) {
    return {-direction.x(), -direction.y(), direction.z()};
}

}  // namespace paim
