// Light on a mesh of which a part has a place of its own.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "paim/light/light.h"

namespace paim {

// Radiance of a mesh whose first `num_following` vertices stand in the scene like `root`. The others, a
// floor, have the axes of the scene.
// light     of the scene
// radiance  [V]
// scratch   memory that is kept from call to call
// shade     called as shade(light, radiance): sets `radiance` to that of all vertices under a light in
//           their axes. Called a second time if the two lights differ.
template <typename Shade>
void light_in_place(const RigidTransform& root, size_t num_following,
                    const LightCoefficients& light, std::vector<Vec3f>& radiance,
                    std::vector<Vec3f>& scratch, Shade&& shade) {
    shade(to_local(light, root), radiance);
    if (!root.turns() || num_following >= radiance.size()) return;
    shade(light, scratch);
    const auto first = static_cast<ptrdiff_t>(num_following);
    std::copy(scratch.begin() + first, scratch.end(), radiance.begin() + first);
}

}  // namespace paim
