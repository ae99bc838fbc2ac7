// Where each pose of a moving mesh stands in the scene, apart from its shape.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "paim/base/export.h"
#include "paim/base/vector.h"

namespace paim {

// A rotation, then a translation: scene = rotation · local + translation.
struct RigidTransform {
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit
    Vec3d translation = Vec3d::Zero();  // scene units, relative to the origin of the sequence

    bool is_identity() const { return !turns() && translation.isZero(0.0); }
    bool turns() const { return !rotation.vec().isZero(0.0); }
    Vec3d to_scene(const Vec3d& local) const { return rotation * local + translation; }
    Vec3d to_local(const Vec3d& scene) const {
        return rotation.conjugate() * (scene - translation);
    }
    bool operator==(const RigidTransform& other) const {
        return rotation.coeffs() == other.rotation.coeffs() && translation == other.translation;
    }
};

// A rotation as its axis times its angle, 0 … π radians, and back.
Vec3d rotation_vector(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond rotation_of(const Vec3d& vector);

// Rotation vectors of bakes are multiples of this, and translations of about this share of the
// body's size. That is as fine as floats of a vertex.
constexpr double kRotationUnit_rad = 0x1p-22;

// [P] one transform a pose; or empty: local coordinates are scene coordinates in every pose.
using RootMotion = std::vector<RigidTransform>;

// A number of vertices: however many there are.
constexpr uint32_t kAllVertices = std::numeric_limits<uint32_t>::max();

// The transform at `time` in poses, clamped to 0 … P−1 (0 if it is not a number). Between two poses translations are
// interpolated linearly, rotations along the shorter arc at constant speed (slerp). The identity if
// the motion is empty.
PAIM_EXPORT RigidTransform root_at(const RootMotion& motion, double time);

// Moves points of a pose from local coordinates to the scene, in double, in place.
// planes         [3][V]: all x, then all y, then all z
// num_following  how many points, from the first, move; the others, a floor, keep their place
PAIM_EXPORT void move_to_scene(const RigidTransform& root, std::span<float> planes,
                               uint32_t num_following = kAllVertices);

// How far a body goes: the length of its path and the sum of the angles between poses.
struct Travel {
    double distance = 0.0;   // scene units
    double angle_deg = 0.0;  // degrees
};
Travel travel_of(const RootMotion& motion);

}  // namespace paim
