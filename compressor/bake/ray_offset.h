// Distance of the start of shadow rays from the surface.
#pragma once

#include <limits>
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

// The faces with area at a vertex.
struct VertexFaces {
    double shortest = std::numeric_limits<double>::infinity();  // edge, scene units
    float largest = 0.0f;                                       // coordinate
    // Cosines of the angles between the vertex normal and the normals of the faces.
    double lowest_cosine = 1.0, highest_cosine = -1.0;

    bool any() const { return shortest < std::numeric_limits<double>::infinity(); }
    // The rounding of the place where a ray crosses a face, scene units.
    double rounding() const { return std::numeric_limits<float>::epsilon() * double{largest}; }
};

// positions  [V]
// normals    [V] unit or zero; empty: cosines are not computed
// returns    [V]
std::vector<VertexFaces> measure_vertex_faces(const Topology& topology,
                                              std::span<const Vec3f> positions,
                                              std::span<const Vec3f> normals);

// Distance along the vertex normal at which the rays of each vertex start, scene units: the larger
// of the two distances of the rule, over the faces with area at the vertex. It scales with the
// mesh, and does not depend on duplicate faces or on the order of faces. Where faces are steep
// against the normal, the baker goes further or another way (ray_start.h).
// positions  [V]
// returns    [V], 0 if the vertex has no face with area
std::vector<float> ray_offsets(const Topology& topology, std::span<const Vec3f> positions,
                               const RayOffsetRule& rule = {});

}  // namespace paim
