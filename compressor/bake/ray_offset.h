// How far shadow rays start off the surface.
#pragma once

#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Compared with other ways in docs/results/ray_offsets.md.
struct RayOffsetRule {
    double of_edge = 1e-4;  // of the shortest edge round a vertex: small against detail
    double of_coordinate =
        4.0;  // roundings (2⁻²³) of the largest coordinate there: above all rounding
};

// Distance along the vertex normal at which the rays of each vertex start, scene units: the larger
// of the rule's two, over the faces with area round the vertex. It scales with the mesh, and
// neither duplicate faces nor their order change it.
// positions [V]; returns [V], 0 where there is no such face
std::vector<float> ray_offsets(const Topology& topology, std::span<const Vec3f> positions,
                               const RayOffsetRule& rule = {});

}  // namespace paim
