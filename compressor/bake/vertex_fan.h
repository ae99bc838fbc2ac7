// The faces round one vertex: where they are open, and which directions they hide.
// Based on: Bærentzen and Aanæs, Signed Distance Computation Using the Angle Weighted Pseudonormal,
//           2005
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A cone of faces with the vertex as its apex. It divides the directions at the vertex into those
// in front of the faces and those behind them.
class VertexFan {
  public:
    // Takes the faces with area that have `v`, and those that continue them across edges of exactly
    // two faces where vertices share places. Of faces that lie on each other, one counts. Faces are
    // turned to face like the first, where neighbours disagree, and all of them to the side of the
    // normal, which is their front unless the normal clearly points to their back.
    // places     [V] the vertices that lie where others do (mesh/places.h); empty if none do
    // triangles  numbers of the triangles with a corner at the place of v, those of v first
    // normal     of v, unit
    VertexFan(const Topology& topology, std::span<const Vec3f> positions,
              std::span<const uint32_t> places, uint32_t v, std::span<const uint32_t> triangles,
              const Vec3f& normal);

    // The sine of the angle by which the direction (unit) rises above the face above which it rises
    // least. Negative if it lies behind the plane of any face. 1 if there is no face.
    double clearance(const Vec3d& direction) const;

    // A unit direction whose clearance is at least 0.9 of the largest that there is. Zero if the
    // largest is below `smallest`.
    Vec3d most_open_direction(double smallest) const;

    // Whether the direction lies behind the faces: which side of the nearest point of the cone it
    // is on. A direction that faces on both sides are equally near to is not hidden.
    bool hides(const Vec3d& direction) const;

    // All triangles at the place of the vertex, in ascending order.
    std::span<const uint32_t> triangles() const { return triangles_; }

  private:
    struct Face {
        Vec3d normal;      // unit, to the front
        Vec3d edges[2];    // unit, from the vertex
        uint32_t ends[2];  // places of their ends
        bool is_own;       // of v itself
    };
    struct Edge {
        Vec3d direction;  // unit
        Vec3d normal;     // sum of those of its faces
    };

    std::vector<Face> collect(const Topology& topology, std::span<const Vec3f> positions,
                              std::span<const uint32_t> places, uint32_t v,
                              std::span<const uint32_t> triangles) const;
    void connect(std::vector<Face> all, const Vec3f& normal);
    void find_edges();

    std::vector<uint32_t> triangles_;
    std::vector<Face> faces_;
    std::vector<Edge> edges_;
    Vec3d normal_ = Vec3d::Zero();  // sum of the faces' normals times their angles
};

}  // namespace paim
