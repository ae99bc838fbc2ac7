// Middles of poses and their moving average.
#include "player/view/body_path.h"

#include <algorithm>
#include <cmath>

#include "paim/mesh/face_vertices.h"

namespace paim::player {

std::vector<uint32_t> body_vertices(const CodedMesh& mesh) {
    std::vector<uint32_t> vertices = face_vertices(mesh.topology);
    std::erase_if(vertices, [&](uint32_t v) { return v >= mesh.num_following; });
    return vertices;
}

BodyPath::BodyPath(const Asset& asset)
    : mesh_(asset.moving()),
      reach_(static_cast<size_t>(std::clamp(0.25 * double{asset.frames_per_second}, 0.0, 64.0))),
      vertices_(body_vertices(mesh_)),
      middles_(mesh_.num_poses()),
      smooth_(mesh_.num_poses()) {}

Vec3d BodyPath::at(double time) {
    const double clamped = std::clamp(time, 0.0, static_cast<double>(middles_.size()) - 1.0);
    const double before = std::floor(clamped);
    const Vec3d from = smooth_at(static_cast<size_t>(before));
    if (before == clamped) return from;
    return from + (clamped - before) * (smooth_at(static_cast<size_t>(before) + 1) - from);
}

Vec3d BodyPath::smooth_at(size_t pose) {
    if (smooth_[pose]) return *smooth_[pose];
    // Fewer poses at the ends, as many on either side.
    const size_t reach = std::min({reach_, pose, middles_.size() - 1 - pose});
    Vec3d sum = Vec3d::Zero();
    for (size_t p = pose - reach; p <= pose + reach; ++p) sum += middle_of(p);
    smooth_[pose] = sum / static_cast<double>(2 * reach + 1);
    return *smooth_[pose];
}

const Vec3d& BodyPath::middle_of(size_t pose) {
    if (middles_[pose]) return *middles_[pose];
    const LowRank& positions = mesh_.positions;
    decoder_.decode(positions, static_cast<double>(pose), positions.num_usual_components(),
                    planes_);
    const RigidTransform root = root_at(mesh_.root_motion, static_cast<double>(pose));
    const Bounds bounds = bounds_of_vertices(planes_, vertices_);
    middles_[pose] = root.to_scene(bounds.empty() ? Vec3d(Vec3d::Zero())
                                                  : Vec3d(bounds.center().cast<double>()));
    return *middles_[pose];
}

}  // namespace paim::player
