// Yaw, pitch and roll to a rotation and back.
#include "player/light/light_orientation.h"

#include <cmath>

namespace paim::player {

namespace {

// Cosines of the pitch below this are taken as 0: yaw and roll then have half of their digits left.
constexpr double kPoleCosine = 1e-8;
constexpr double kDragDegPerHeight = 180.0;
constexpr double kDegree_rad = kPi / 180.0;

struct Turn {
    double sine, cosine;
};

// Exact at multiples of 90 degrees.
Turn turn_of(double angle_deg) {
    const double quarters = std::nearbyint(std::remainder(angle_deg, 360.0) / 90.0);
    const double rest = kDegree_rad * std::remainder(angle_deg, 90.0);
    const double sine = std::sin(rest), cosine = std::cos(rest);
    switch ((static_cast<int>(quarters) + 4) % 4) {
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        case 3:
            return {-cosine, sine};
        default:
            return {sine, cosine};
    }
}

}  // namespace

LightOrientation LightOrientation::wrapped() const {
    return {std::remainder(yaw_deg, 360.0), std::remainder(pitch_deg, 360.0),
            std::remainder(roll_deg, 360.0)};
}

Eigen::Matrix3d LightOrientation::rotation() const {
    const Turn a = turn_of(yaw_deg), b = turn_of(pitch_deg), c = turn_of(roll_deg);
    Eigen::Matrix3d yaw, pitch, roll;
    yaw << a.cosine, 0, a.sine, 0, 1, 0, -a.sine, 0, a.cosine;
    pitch << 1, 0, 0, 0, b.cosine, -b.sine, 0, b.sine, b.cosine;
    roll << c.cosine, -c.sine, 0, c.sine, c.cosine, 0, 0, 0, 1;
    return yaw * pitch * roll;
}

LightOrientation LightOrientation::of_rotation(const Eigen::Matrix3d& rotation,
                                               double roll_at_pole_deg) {
    // Row 1 is (cos pitch sin roll, cos pitch cos roll, −sin pitch).
    const double cosine = std::hypot(rotation(1, 0), rotation(1, 1));
    LightOrientation result;
    result.pitch_deg = std::atan2(-rotation(1, 2), cosine) / kDegree_rad;
    result.roll_deg = cosine < kPoleCosine
                          ? std::remainder(roll_at_pole_deg, 360.0)
                          : std::atan2(rotation(1, 0), rotation(1, 1)) / kDegree_rad;
    // What is left without the roll is Ry(yaw) · Rx(pitch), whose first column is (cos yaw, 0,
    // −sin yaw) at any pitch. So the yaw makes up for an inexact roll near the poles.
    const Turn roll = turn_of(result.roll_deg);
    const Vec3d column = rotation.col(0) * roll.cosine - rotation.col(1) * roll.sine;
    result.yaw_deg = std::atan2(-column.z(), column.x()) / kDegree_rad;
    return result;
}

LightOrientation drag(const LightOrientation& orientation, const Eigen::Matrix3f& camera_axes,
                      double dx, double dy) {
    const double length = std::hypot(dx, dy);
    if (length == 0.0) return orientation;
    // Dragging right takes the camera's backward axis to its right, dragging down takes it to its
    // negative up.
    const Eigen::Matrix3d axes = camera_axes.cast<double>();
    const Vec3d axis = (dx * axes.col(1) + dy * axes.col(0)).normalized();
    const Eigen::AngleAxisd turn(kDegree_rad * kDragDegPerHeight * length, axis);
    return LightOrientation::of_rotation(turn.toRotationMatrix() * orientation.rotation(),
                                         orientation.roll_deg);
}

}  // namespace paim::player
