// A pose sequence with one topology, read one pose at a time so that memory does not grow with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paim/base/vector.h"
#include "paim/mesh/materials.h"
#include "paim/mesh/texture.h"
#include "paim/mesh/topology.h"

namespace paim {

struct Pose {
    // [V] scene units, relative to the sequence's origin and the offset of the pose; finite where a
    // face has the vertex
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;  // [V] unit; zero where a vertex has no face of any area
};

class PoseSource {
  public:
    virtual ~PoseSource() = default;

    virtual const Topology& topology() const = 0;
    virtual const Albedo& albedo() const = 0;
    // Glossy reflection; by default there is none.
    virtual const Materials& materials() const;
    // Images on the faces; by default there are none.
    virtual const Texture& texture() const;
    virtual uint32_t num_poses() const = 0;

    // Positions of all poses are relative to it: adding it, in double, gives scene coordinates.
    // Zero unless the mesh is far from the world's origin (mesh/origin.h).
    virtual Vec3d origin() const { return Vec3d::Zero(); }

    // What is added to the positions of pose p, in double, to make them relative to the origin. Zero
    // unless the mesh travels so far that its poses need origins of their own (mesh/origin.h).
    virtual Vec3d pose_offset(uint32_t /*p*/) const { return Vec3d::Zero(); }

    // How many vertices, from the first, belong to what moves. The others are a floor, which is at
    // the same place in every pose.
    virtual uint32_t num_moving_vertices() const { return topology().num_vertices; }

    // A name for messages and manifests: a file name, or what made the pose.
    virtual std::string pose_name(uint32_t p) const = 0;

    // A checksum of the input of pose p. A resumed bake compares it to find out whether the input
    // has changed.
    virtual uint64_t pose_checksum(uint32_t p) const = 0;

    // Reads pose p < num_poses(). May be called from several threads at once.
    virtual Pose load_pose(uint32_t p) const = 0;

    // Its positions alone, which may be less work. May be called from several threads at once.
    virtual std::vector<Vec3f> load_positions(uint32_t p) const { return load_pose(p).positions; }
};

// Pose p with positions relative to the origin, which floats of a mesh that travels far hold less
// exactly.
Pose load_from_origin(const PoseSource& source, uint32_t p);

// Its positions alone.
std::vector<Vec3f> load_positions_from_origin(const PoseSource& source, uint32_t p);

}  // namespace paim
