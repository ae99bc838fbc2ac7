// Bounds of decoded poses.
#include "paim/codec/sequence_bounds.h"

#include <algorithm>

#include "paim/codec/pose_parts.h"
#include "paim/mesh/planes.h"

namespace paim {

namespace {

// Multiply-adds that sequence_bounds() may spend: about two seconds on one core.
constexpr uint64_t kMaxWork = uint64_t{1} << 33;

void extend(Bounds& bounds, const Bounds& other) {
    bounds.lower = bounds.lower.cwiseMin(other.lower);
    bounds.upper = bounds.upper.cwiseMax(other.upper);
}

// The bounds and what of the scenery is within so many of their diagonals.
Bounds with_scenery(const Bounds& bounds, std::span<const float> scenery_positions,
                    double diagonals) {
    Bounds scenery;
    scenery.extend(from_planes(scenery_positions));
    if (scenery.empty()) return bounds;
    Bounds all = bounds;
    extend(all, scenery);
    const double reach = diagonals * static_cast<double>(bounds.diagonal());
    if (!(reach > 0.0)) return all;  // of a point, whatever there is
    const Vec3d around = Vec3d::Constant(reach);
    all.lower = all.lower.cwiseMax((bounds.lower.cast<double>() - around).cast<float>());
    all.upper = all.upper.cwiseMin((bounds.upper.cast<double>() + around).cast<float>());
    return all;
}

Bounds positions_bounds(const Model& model, double time, uint32_t num_geometry_components) {
    DecodeLimits limits;
    limits.geometry_components = num_geometry_components;
    DecodedPose pose;
    decode_positions(model, time, limits, pose);
    Bounds bounds;
    bounds.extend(from_planes(pose.positions));
    return bounds;
}

}  // namespace

Bounds pose_bounds(const Model& model, double time, uint32_t num_geometry_components) {
    constexpr double kSeenDiagonals = 500.0;
    return with_scenery(positions_bounds(model, time, num_geometry_components),
                        model.scenery.positions.floats(), kSeenDiagonals);
}

Bounds framed_bounds(const Bounds& poses, std::span<const float> scenery_positions) {
    constexpr double kFramedDiagonals = 1.0;
    return with_scenery(poses, scenery_positions, kFramedDiagonals);
}

Bounds sequence_bounds(const Model& model) {
    const uint64_t pose_work =
        uint64_t{3} * model.topology.num_vertices * (uint64_t{model.geometry.num_components} + 1);
    const uint64_t num_poses = model.num_poses();
    const uint64_t max_samples = std::max<uint64_t>(2, kMaxWork / std::max<uint64_t>(1, pose_work));
    const uint64_t step = (num_poses + max_samples - 1) / max_samples;
    Bounds bounds;
    const auto extend_by = [&](uint64_t p) {
        extend(bounds,
               positions_bounds(model, static_cast<double>(p), model.geometry.num_components));
    };
    for (uint64_t p = 0; p < num_poses; p += step) extend_by(p);
    extend_by(num_poses - 1);
    return framed_bounds(bounds, model.scenery.positions.floats());
}

}  // namespace paim
