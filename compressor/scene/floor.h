// Poses of another source with a floor under them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "paim/mesh/bounds.h"
#include "paim/mesh/pose_source.h"
#include "paim/mesh/root_motion.h"

namespace paim {

struct FloorOptions {
    uint32_t num_vertices = 4000;          // at most; kMinFloorVertices or more
    Vec3f albedo = Vec3f::Constant(0.8f);  // linear, 0..1
};

constexpr uint32_t kMinFloorVertices = 16;
constexpr uint32_t kMaxFloorVertices = 4'000'000;

// Where the poses are, and how large the body is.
struct BodyBounds {
    Bounds all;                // over all poses
    double body_extent = 0.0;  // the largest extent of a pose; of these the median over the poses
};

// A horizontal rectangle that faces up (+Y), just below the lowest point of all poses. Its cells
// are squares of one size under the poses and a little beyond. From there to its edge, at a
// distance of 0.3 of the largest extent of all poses, they grow. The gap below the lowest point is
// relative to the body, so that one that travels far does not float.
struct Floor {
    Topology topology;
    std::vector<Vec3f> positions;  // [N] scene units
    float height = 0.0f;           // y of all positions

    // bounds  not empty
    // Error (bad input) if the bounds are a point, or so large that the floor is not finite.
    Floor(const BodyBounds& bounds, uint32_t max_vertices);
};

// Bounds of the vertices of triangles. Vertices without triangles do not count,
// because they cannot be seen, and neither do outliers (mesh/outliers.h), which are found in local
// coordinates, so that a path hides none. Each pose is read once, or three times if there may be
// outliers.
// on_pose      called once after each pose, from several threads at once
// root_motion  of the source, [P] or empty
BodyBounds bounds_of(const PoseSource& source, const std::function<void()>& on_pose = {},
                     const RootMotion& root_motion = {});

// The poses of a source with a floor. The floor's vertices and triangles follow those of the source
// and are the same in every pose, so that they are lit, shadowed and compressed with the others.
class PosesOnFloor : public PoseSource {
  public:
    // Keeps a reference to the source.
    // bounds  of all its poses
    // Errors: those of Floor; bad input if there would be too many vertices.
    PosesOnFloor(const PoseSource& source, const BodyBounds& bounds, const FloorOptions& options);

    const Topology& topology() const override { return topology_; }
    const Albedo& albedo() const override { return albedo_; }
    const Materials& materials() const override { return materials_; }
    const Texture& texture() const override { return texture_; }
    uint32_t num_poses() const override { return source_.num_poses(); }
    Vec3d origin() const override { return source_.origin(); }
    uint32_t num_moving_vertices() const override { return source_.topology().num_vertices; }
    std::string pose_name(uint32_t p) const override { return source_.pose_name(p); }
    uint64_t pose_checksum(uint32_t p) const override;  // of the positions of source and floor
    Pose load_pose(uint32_t p) const override;

    // The floor in words, for manifests and messages. Different floors have different descriptions.
    const std::string& description() const { return description_; }

  private:
    const PoseSource& source_;
    Floor floor_;
    Topology topology_;
    Albedo albedo_;
    Materials materials_;  // the floor is matte
    Texture texture_;
    uint64_t positions_xxh3_;
    std::string description_;
};

}  // namespace paim
