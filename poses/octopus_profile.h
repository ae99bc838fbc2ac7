// Curves of the surface of the octopus at rest: meridians of the body, and cross-sections of the
// arms.
#pragma once

#include <vector>

#include "paim/base/vector.h"

namespace paim::poses {

// The eight arms leave the body where neighbouring arms part. There, at distance rim_s() along an
// arm's axis, the body's upper and lower sheet end and the arms' tubes begin.
double rim_s();

// A point of an arm's surface relative to a point s on its axis: the hit of the ray in direction
// cos(tilt) (cos(turn) lateral + sin(turn) up) + sin(tilt) outward, cut where the neighbour's
// sector begins. Returned as (s, up, lateral).
Vec3d arm_surface(double s, double turn_rad, double tilt_rad);

// Meridians of one sheet of the body (without eyes), from the axis to the rim, by arc length.
class Sheet {
  public:
    enum class Side { upper, lower };
    explicit Sheet(Side side);

    // Distance from the axis and height at the fraction 0 (axis) … 1 (rim) of the meridian whose
    // azimuth differs by `offset_rad` (at most half a sector) from the arm's axis.
    Eigen::Vector2d at(double offset_rad, double fraction) const;

    // Length of the meridian in the middle of an arm, scene units.
    double length() const { return length_; }

  private:
    std::vector<std::vector<Eigen::Vector2d>> meridians_;  // [offset][fraction]
    double length_ = 0.0;
};

}  // namespace paim::poses
