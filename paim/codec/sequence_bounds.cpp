// Bounds of decoded poses.
#include "paim/codec/sequence_bounds.h"

#include <algorithm>
#include <vector>

#include "paim/codec/rebuild_planes.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

// The bounds of the moving part, enlarged by those of the still parts as far as `diagonals` times
// the diagonal of the former around them.
Bounds with_still(const Bounds& bounds, const Bounds& still, double diagonals) {
    if (still.empty()) return bounds;
    Bounds all = bounds;
    all.extend(still);
    const double reach = diagonals * static_cast<double>(bounds.diagonal());
    if (!(reach > 0.0)) return all;  // the moving part is a point: all still parts count
    const Vec3d around = Vec3d::Constant(reach);
    all.lower = all.lower.cwiseMax((bounds.lower.cast<double>() - around).cast<float>());
    all.upper = all.upper.cwiseMin((bounds.upper.cast<double>() + around).cast<float>());
    return all;
}

Bounds still_bounds(const Asset& asset) {
    Bounds bounds;
    for (size_t j = 1; j < asset.parts.size(); ++j) {
        const CodedMesh& mesh = asset.parts[j];
        bounds.extend(
            bounds_of_vertices(mesh.positions.mean_floats(), face_vertices(mesh.topology)));
    }
    return bounds;
}

// Bounds of poses of the moving part; keeps its memory from pose to pose.
class MovingBounds {
  public:
    explicit MovingBounds(const CodedMesh& mesh)
        : mesh_(mesh),
          num_usual_(mesh.positions.num_usual_components()),
          vertices_(face_vertices(mesh.topology)) {}

    Bounds at(double time, uint32_t num_components) {
        decoder_.decode(mesh_.positions, time, std::min(num_components, num_usual_), planes_);
        move_to_scene(root_at(mesh_.root_motion, time), planes_, mesh_.num_following);
        return bounds_of_vertices(planes_, vertices_);
    }

  private:
    const CodedMesh& mesh_;
    const uint32_t num_usual_;
    const std::vector<uint32_t> vertices_;
    PositionDecoder decoder_;
    std::vector<float> planes_;
};

}  // namespace

Bounds pose_bounds(const Asset& asset, double time, uint32_t num_geometry_components) {
    constexpr double kSeenDiagonals = 500.0;
    return with_still(MovingBounds(asset.moving()).at(time, num_geometry_components),
                      still_bounds(asset), kSeenDiagonals);
}

Bounds framed_bounds(const Bounds& poses, const Bounds& still) {
    constexpr double kFramedDiagonals = 1.0;
    return with_still(poses, still, kFramedDiagonals);
}

Bounds sequence_bounds(const Asset& asset, uint64_t max_multiply_adds) {
    const LowRank& positions = asset.moving().positions;
    const uint64_t pose_work =
        uint64_t{3} * positions.num_points * (uint64_t{positions.num_components} + 1);
    const uint64_t num_poses = asset.num_poses();
    const uint64_t max_samples =
        std::max<uint64_t>(2, max_multiply_adds / std::max<uint64_t>(1, pose_work));
    const uint64_t step = (num_poses + max_samples - 1) / max_samples;
    MovingBounds moving(asset.moving());
    Bounds bounds;
    const auto extend_by = [&](uint64_t p) {
        bounds.extend(moving.at(static_cast<double>(p), positions.num_components));
    };
    for (uint64_t p = 0; p < num_poses; p += step) extend_by(p);
    extend_by(num_poses - 1);
    return framed_bounds(bounds, still_bounds(asset));
}

}  // namespace paim
