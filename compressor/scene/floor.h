// The poses of another source with a ground under them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "paim/mesh/bounds.h"
#include "paim/mesh/pose_source.h"

namespace paim {

struct FloorOptions {
    uint32_t num_vertices = 4000;          // at most; kMinFloorVertices or more
    Vec3f albedo = Vec3f::Constant(0.8f);  // linear, 0..1
};

constexpr uint32_t kMinFloorVertices = 16;
constexpr uint32_t kMaxFloorVertices = 4'000'000;

// A horizontal rectangle that faces up (+Y), just under the lowest point of all poses. Under them
// and a little beyond, its cells are squares of one size; from there to its edge, 0.3 of the
// largest extent of the poses away, they grow.
struct Floor {
    Topology topology;
    std::vector<Vec3f> positions;  // [N] scene units
    float height = 0.0f;           // their y

    // bounds  of all poses, not empty
    // Error (bad input) if the bounds are a point, or so large that the floor is not finite.
    Floor(const Bounds& bounds, uint32_t max_vertices);
};

// Bounds of the vertices that a triangle has, in all poses; every one is read once. A vertex in no
// triangle cannot be seen, and a floor goes by what can.
// on_pose  called after each pose, from several threads at once
Bounds bounds_of(const PoseSource& source, const std::function<void()>& on_pose = {});

// The floor's vertices and triangles come after the source's, the same in every pose, so that they
// are lit, shadowed and compressed with the rest.
class PosesOnFloor : public PoseSource {
  public:
    // Keeps a reference to the source.
    // bounds  of all its poses
    // Errors: those of Floor; bad input if there would be too many vertices.
    PosesOnFloor(const PoseSource& source, const Bounds& bounds, const FloorOptions& options);

    const Topology& topology() const override { return topology_; }
    const Albedo& albedo() const override { return albedo_; }
    uint32_t num_poses() const override { return source_.num_poses(); }
    Vec3d origin() const override { return source_.origin(); }
    std::string pose_name(uint32_t p) const override { return source_.pose_name(p); }
    uint64_t pose_checksum(uint32_t p) const override;  // of the source's and the floor's positions
    Pose load_pose(uint32_t p) const override;

    // For manifests and messages: what a reader needs to tell one floor from another.
    const std::string& description() const { return description_; }

  private:
    const PoseSource& source_;
    Floor floor_;
    Topology topology_;
    Albedo albedo_;
    uint64_t positions_xxh3_;
    std::string description_;
};

}  // namespace paim
