// Vertices that lie exactly where others do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

// [V] The lowest number of the vertices that lie exactly where this one does (−0 is 0). Empty if no
// two vertices have the same position.
// positions  [V] finite
// within     [V] Places of another pose: vertices share a place only if they share one there, too.
//            Empty: no condition
std::vector<uint32_t> first_at_position(std::span<const Vec3f> positions,
                                        std::span<const uint32_t> within = {});
std::vector<uint32_t> first_at_position(std::span<const Vec3d> positions,
                                        std::span<const uint32_t> within = {});

// [V] The places of vertices that share one in both. Empty if there are none.
// a, b  [V], or empty: no two vertices share a place
std::vector<uint32_t> shared_places(std::span<const uint32_t> a, std::span<const uint32_t> b);

}  // namespace paim
