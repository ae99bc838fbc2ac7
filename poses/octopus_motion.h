// How the octopus moves: each arm bends along its axis, the mantle breathes and nods.
#pragma once

#include <array>
#include <vector>

#include "paim/base/vector.h"
#include "poses/octopus_shape.h"

namespace paim::poses {

// Angles between the direction of an arm's axis and straight outwards: above the horizon, then to
// the lateral side about the vertical, then out of the plane of these two.
struct ArmBend {
    double pitch_rad, yaw_rad, skew_rad;
};

// An arm's axis in one moment: position and direction of its cross-sections along s.
class ArmCurve {
  public:
    // phase_rad is the moment of the loop, 0 … 2π.
    ArmCurve(int arm, double phase_rad);

    // The place of the point of the rest pose that is (s, up, lateral) in the arm's frame.
    Vec3d place(double s, double up, double lateral) const;

    // The axis itself.
    Vec3d center(double s) const { return place(s, 0.0, 0.0); }

  private:
    struct Section {
        Vec3d center;
        ArmBend bend;
    };
    // Columns: along the axis, up, and lateral of the cross-section.
    Eigen::Matrix3d frame(const ArmBend& bend) const;

    ArmAxes axes_;
    std::vector<Section> sections_;
};

// The whole animal in one moment of the loop.
class OctopusMotion {
  public:
    explicit OctopusMotion(double phase_rad);

    // The place of a point of the rest pose. It is smooth in the point: neighbouring arms are
    // blended over the web between them, and arms and mantle over the neck.
    Vec3d place(const Vec3d& rest) const;

    const ArmCurve& arm(int k) const { return arms_[static_cast<size_t>(k)]; }

  private:
    Vec3d place_body(const Vec3d& rest) const;
    Vec3d place_on_arms(const Vec3d& rest) const;

    double phase_rad_;
    std::vector<ArmCurve> arms_;
};

}  // namespace paim::poses
