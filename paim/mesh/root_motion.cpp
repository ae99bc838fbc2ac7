// Where each pose of a moving mesh stands in the scene, apart from its shape.
#include "paim/mesh/root_motion.h"

#include <algorithm>
#include <cmath>

#include "paim/mesh/planes.h"

namespace paim {

Vec3d rotation_vector(const Eigen::Quaterniond& rotation) {
    const double sine = rotation.vec().norm();
    if (sine == 0.0) return Vec3d::Zero();
    const double sign = rotation.w() < 0.0 ? -1.0 : 1.0;
    const double angle = 2.0 * std::atan2(sine, sign * rotation.w());
    return sign * angle / sine * rotation.vec();
}

Eigen::Quaterniond rotation_of(const Vec3d& vector) {
    const double angle = vector.norm();
    if (angle == 0.0) return Eigen::Quaterniond::Identity();
    const Vec3d axis = vector / angle;
    const double sine = std::sin(0.5 * angle);
    return {std::cos(0.5 * angle), sine * axis.x(), sine * axis.y(), sine * axis.z()};
}

RigidTransform root_at(const RootMotion& motion, double time) {
    if (motion.empty()) return {};
    const double number = std::isnan(time) ? 0.0 : time;
    const double clamped = std::clamp(number, 0.0, static_cast<double>(motion.size()) - 1.0);
    const auto before = static_cast<size_t>(clamped);
    const double share = clamped - std::floor(clamped);
    if (share == 0.0) return motion[before];
    const RigidTransform& a = motion[before];
    const RigidTransform& b = motion[before + 1];
    RigidTransform root;
    root.rotation = a.turns() || b.turns() ? a.rotation.slerp(share, b.rotation) : a.rotation;
    root.translation = (1.0 - share) * a.translation + share * b.translation;
    return root;
}

void move_to_scene(const RigidTransform& root, std::span<float> planes, uint32_t num_following) {
    if (root.is_identity()) return;
    transform_planes(root.rotation.toRotationMatrix(), root.translation, planes, num_following);
}

Travel travel_of(const RootMotion& motion) {
    Travel travel;
    for (size_t p = 1; p < motion.size(); ++p) {
        travel.distance += (motion[p].translation - motion[p - 1].translation).norm();
        travel.angle_deg +=
            motion[p].rotation.angularDistance(motion[p - 1].rotation) * 180.0 / kPi;
    }
    return travel;
}

}  // namespace paim
