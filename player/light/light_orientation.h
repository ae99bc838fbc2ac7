// How an environment is turned in the scene: three angles, and turning it with the pointer.
#pragma once

#include "paim/base/vector.h"

namespace paim::player {

// Angles in degrees, finite, of any size.
struct LightOrientation {
    double yaw_deg = 0.0;    // about +Y of the scene, counter-clockwise seen from above
    double pitch_deg = 0.0;  // about the environment's +X
    double roll_deg = 0.0;   // about the environment's +Z

    bool operator==(const LightOrientation&) const = default;

    // The same orientation with angles from −180 to 180.
    LightOrientation wrapped() const;

    // Ry(yaw) · Rx(pitch) · Rz(roll), each counter-clockwise about its axis: light that comes from
    // the direction d of the environment reaches the scene from rotation() · d. The rotation about
    // +Z is the first to act on d. With pitch and roll 0 it is the turn of turn_about_y() and
    // --env-rotation. Multiples of 90 degrees turn without rounding.
    Eigen::Matrix3d rotation() const;

    // The orientation with this rotation: yaw and roll from −180 to 180, pitch from −90 to 90. Where
    // the pitch is ±90, only one combination of yaw and roll is determined; the roll is then the
    // given one.
    // rotation  orthogonal with determinant 1, to rounding
    static LightOrientation of_rotation(const Eigen::Matrix3d& rotation, double roll_at_pole_deg);
};

// The orientation after a drag of the pointer. The environment turns about the camera's up and right
// axes like a ball whose near side follows the pointer: a light behind the camera, which shines on
// what faces the viewer, moves the way the pointer does. A drag as long as the window is high turns
// by 180 degrees.
// camera_axes  right, up, backward in the scene (Camera::axes())
// dx, dy       as fractions of the window's height, right and down positive
LightOrientation drag(const LightOrientation& orientation, const Eigen::Matrix3f& camera_axes,
                      double dx, double dy);

}  // namespace paim::player
