// Bounds of decoded poses.
#include "paim/codec/sequence_bounds.h"

#include <algorithm>

#include "paim/codec/svd_decoder.h"
#include "paim/mesh/planes.h"

namespace paim {

namespace {

// Multiply-adds that sequence_bounds() may spend: about two seconds on one core.
constexpr uint64_t kMaxWork = uint64_t{1} << 33;

void extend(Bounds& bounds, const Bounds& other) {
    bounds.lower = bounds.lower.cwiseMin(other.lower);
    bounds.upper = bounds.upper.cwiseMax(other.upper);
}

}  // namespace

Bounds pose_bounds(const Model& model, double time, uint32_t num_geometry_components) {
    DecodeLimits limits;
    limits.geometry_components = num_geometry_components;
    limits.transfer_components = 0;
    limits.bands = 1;
    DecodedPose pose;
    SvdDecoder(model).decode(time, limits, pose);
    Bounds bounds;
    bounds.extend(from_planes(pose.positions));
    return bounds;
}

Bounds sequence_bounds(const Model& model) {
    const uint64_t pose_work =
        uint64_t{3} * model.topology.num_vertices * (uint64_t{model.geometry.num_components} + 1);
    const uint64_t num_poses = model.num_poses();
    const uint64_t max_samples = std::max<uint64_t>(2, kMaxWork / std::max<uint64_t>(1, pose_work));
    const uint64_t step = (num_poses + max_samples - 1) / max_samples;
    Bounds bounds;
    for (uint64_t p = 0; p < num_poses; p += step) {
        extend(bounds, pose_bounds(model, static_cast<double>(p), model.geometry.num_components));
    }
    extend(bounds,
           pose_bounds(model, static_cast<double>(num_poses - 1), model.geometry.num_components));
    return bounds;
}

}  // namespace paim
