// The octopus at rest as a closed triangle mesh with a given number of vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim::poses {

struct RestMesh {
    Topology topology;
    std::vector<Vec3d> positions;  // [V] on the surface of octopus_shape.h
};

// Two sheets of revolution, apex to rim and mouth to rim, joined by eight tubes: each arm's tube
// grows from an arc of the upper rim and the arc of the lower rim below it, and neighbouring arms
// share one vertex of the web between them. Closed, oriented, one component, Euler characteristic
// 2, exactly num_vertices vertices.
RestMesh make_rest_octopus(uint32_t num_vertices);

}  // namespace paim::poses
