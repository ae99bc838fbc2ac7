// Chooses the numbers of rings and columns of the octopus, so that it has the wanted number of
// vertices.
#pragma once

#include <cstdint>
#include <vector>

namespace paim::poses {

// Lengths on the octopus at rest that a plan is made from, scene units.
struct OctopusSizes {
    std::vector<double> upper_radii, lower_radii;  // distance from the axis at equal steps of arc
    double upper_length, lower_length;             // of a meridian, axis to rim
    double arm_length;                             // rim to the tip's centre
};

// One ring of a sheet or an arm. Rings go from the rim towards the pole (apex, mouth or tip) and
// keep the columns 0, stride, 2·stride … of the rim's.
struct RingPlan {
    double
        fraction;  // sheets: 1 at the rim, 0 at the pole; arms: 0 at the rim, 1 at the tip's centre
    double tilt_rad = 0;  // arms: > 0 on the tip's cap
    uint32_t stride;
};

struct OctopusPlan {
    uint32_t num_columns;  // across the upper (or lower) half of an arm where it leaves the body
    std::vector<RingPlan> upper, lower, arm;  // without the rim itself
    uint32_t num_vertices = 0;
};

// Spacing of an arm's rings shrinks towards the tip to this share of that at the rim.
constexpr double kArmSpacingAtTip = 0.45;

// Distance along the arm, as a share of it, of the ring at `fraction`.
double arm_ring_share(double fraction);

// The plan with the largest number of vertices up to the wanted one, with triangles about as long
// as wide.
OctopusPlan plan_octopus(const OctopusSizes& sizes, uint32_t num_vertices);

}  // namespace paim::poses
