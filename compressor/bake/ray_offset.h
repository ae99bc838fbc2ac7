// Distance of the start of shadow rays from the surface.
#pragma once

#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Factors of the rule. docs/results/ray_offsets.md compares it with others.
struct RayOffsetRule {
    double of_edge = 1e-4;  // times the shortest edge at a vertex: small compared with details
    double of_coordinate =
        4.0;  // times the rounding (2⁻²³) of the largest coordinate there: above all rounding
};

// Distance along the vertex normal at which the rays of each vertex start, scene units: the larger
// of the two distances of the rule, over the faces with area at the vertex. It scales with the
// mesh, and does not depend on duplicate faces or on the order of faces.
// positions  [V]
// returns    [V], 0 if the vertex has no face with area
std::vector<float> ray_offsets(const Topology& topology, std::span<const Vec3f> positions,
                               const RayOffsetRule& rule = {});

}  // namespace paim
