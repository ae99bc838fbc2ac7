// The octopus at rest as an implicit surface: mantle, head, eight straight arms, two eyes.
// Based on: Quílez, Distance functions and smooth minimum (round cones; exponential smooth minimum)
#pragma once

#include <array>

#include "paim/base/vector.h"

namespace paim::poses {

constexpr int kNumArms = 8;
constexpr double kSector_rad = 2.0 * kPi / kNumArms;  // the share of the full turn of one arm
constexpr double kArmLength = 5.0;                    // from the axis to the tip's centre
constexpr double kArmTipRadius = 0.05;

// Direction of arm k in the plane y = 0, its lateral direction (to larger azimuth), and up. Azimuth
// is measured from +z towards +x; the face looks along +z, between arms 7 and 0.
struct ArmAxes {
    Vec3d outward, lateral;
};
ArmAxes arm_axes(int arm);

// Radius of the arm at distance s from the axis, as built into the shape.
double arm_radius(double s);

// A value that is negative inside, zero on the surface, and about the distance near it, and its
// gradient. The arms lie in the plane y = 0, the mantle's axis is +y.
struct FieldValue {
    double value;
    Vec3d gradient;
};
FieldValue octopus_body(const Vec3d& point);  // without eyes: the same in all eight sectors
FieldValue octopus_field(const Vec3d& point);

// Moves a point near the surface onto it, along the gradient.
Vec3d project_to_octopus(const Vec3d& point);

// Lifts a point of the body's surface that an eye covers onto the eye, away from the head's axis;
// from there project_to_octopus goes the right way.
Vec3d lift_to_eyes(const Vec3d& point);

// How much finer than elsewhere the mesh should be at a point of the rest surface: 1, more on the
// eyes.
double octopus_fineness(const Vec3d& point);

// Albedo at a point of the rest surface, linear RGB: coral, paler below, white eyes with dark
// pupils.
Vec3f octopus_albedo(const Vec3d& point);

}  // namespace paim::poses
