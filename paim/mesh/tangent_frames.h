// Frames of vertices that move with the surface around them.
// Based on: Müller, Heidelberger, Teschner and Gross, Meshless Deformations Based on Shape Matching,
//           2005 (deformation of edges by least squares)
#pragma once

#include <array>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// The z axis of a frame is the normal of the vertex. In the reference pose the x axis is a direction
// that is the same for all, (0.8, 0.36, 0.48), projected into the plane of the normal, so that frames of
// neighbours are alike.
// In other poses it follows the edges around the vertex: it is t = Σ_e w_e e, without its part along
// the normal of the faces, of unit length. The weights w_e are those with Σ_e w_e e = x axis in the reference pose
// whose Σ w_e² is smallest. So t is the deformation of the edges in the least-squares sense, applied
// to the reference's x axis, and does not depend on the order of faces.
class TangentFrames {
  public:
    // topology   of faces with the same vertices, only the first one counts
    // reference  [V] positions
    TangentFrames(const Topology& topology, std::span<const Vec3f> reference);

    // The z axes are the normals of the faces around the vertices (vertex_normals()).
    // positions  [V] of a pose
    // returns    [V] columns x, y, z, right-handed. Where the edges say nothing (none has a length, there
    //            or in the reference, or t is along the normal), x is that of the reference's rule.
    //            The identity where the normal is zero
    std::vector<Eigen::Matrix3f> at(std::span<const Vec3f> positions) const;

    // The same with other z axes, into whose planes the x axes are projected.
    // normals  [V] unit, or zero: the identity
    std::vector<Eigen::Matrix3f> at(std::span<const Vec3f> positions,
                                    std::span<const Vec3f> normals) const;

  private:
    const Topology topology_;
    // Of the edges from each corner to the next one and to the one after it.
    std::vector<std::array<std::array<double, 2>, 3>> weights_;
};

}  // namespace paim
