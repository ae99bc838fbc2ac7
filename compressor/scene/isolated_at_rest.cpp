// Poses of another source whose isolated vertices do not move.
#include "compressor/scene/isolated_at_rest.h"

#include "paim/base/hash.h"
#include "paim/mesh/bounds.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

IsolatedAtRest::IsolatedAtRest(const PoseSource& source)
    : source_(source), isolated_(isolated_vertices(source.topology())) {
    if (isolated_.empty()) return;
    const Pose first = source.load_pose(0);
    Bounds bounds;
    for (const Triangle& triangle : source.topology().triangles) {
        for (const uint32_t v : triangle) bounds.extend(first.positions[v]);
    }
    place_ = bounds.lower.cwiseMax(Vec3f::Zero()).cwiseMin(bounds.upper);
}

uint64_t IsolatedAtRest::pose_checksum(uint32_t p) const {
    const uint64_t of_source = source_.pose_checksum(p);
    if (isolated_.empty()) return of_source;
    StreamingHash hash;
    hash.update(&of_source, sizeof of_source);
    hash.update(place_.data(), sizeof(Vec3f));
    return hash.digest();
}

Pose IsolatedAtRest::load_pose(uint32_t p) const {
    Pose pose = source_.load_pose(p);
    for (const uint32_t v : isolated_) {
        pose.positions[v] = place_;
        pose.normals[v] = Vec3f::Zero();
    }
    return pose;
}

}  // namespace paim
