// Rings and columns of the octopus.
#include "poses/octopus_plan.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/vector.h"
#include "poses/octopus_shape.h"

namespace paim::poses {

namespace {

// Half the circumference of an arm where it leaves the body, scene units, about.
constexpr double kHalfRim = 1.2;

// A ring whose edges would be shorter than this share of the spacing keeps every other column.
constexpr double kHalvingShare = 0.62;
constexpr uint32_t kMinColumns = 6;

void choose_stride(double circumference, double spacing, uint32_t all_columns, uint32_t& stride) {
    const uint32_t columns = all_columns / stride;
    if (columns % 2 == 0 && columns / 2 >= kMinColumns &&
        circumference / columns < kHalvingShare * spacing) {
        stride *= 2;
    }
}

std::vector<RingPlan> plan_sheet(const std::vector<double>& radii, double length, double spacing,
                                 uint32_t all_columns) {
    const auto num_steps = std::max(2, static_cast<int>(std::lround(length / spacing)));
    std::vector<RingPlan> rings;
    uint32_t stride = 1;
    for (int i = num_steps - 1; i > 0; --i) {
        const double fraction = static_cast<double>(i) / num_steps;
        const auto index =
            static_cast<size_t>(std::lround(fraction * static_cast<double>(radii.size() - 1)));
        choose_stride(2.0 * kPi * radii[index], spacing, all_columns, stride);
        rings.push_back({fraction, 0.0, stride});
    }
    return rings;
}

std::vector<RingPlan> plan_arm(const OctopusSizes& sizes, double spacing, uint32_t all_columns) {
    // Equal steps of a logarithmic scale, on which the arm is this much longer.
    const double stretch = -std::log(kArmSpacingAtTip) / (1.0 - kArmSpacingAtTip);
    const auto num_steps =
        std::max(4, static_cast<int>(std::lround(sizes.arm_length * stretch / spacing)));
    std::vector<RingPlan> rings;
    uint32_t stride = 1;
    const double rim = kArmLength - sizes.arm_length;
    for (int i = 1; i <= num_steps; ++i) {
        const double fraction = static_cast<double>(i) / num_steps;
        const double s = rim + sizes.arm_length * arm_ring_share(fraction);
        choose_stride(2.0 * kPi * arm_radius(s), spacing * std::pow(kArmSpacingAtTip, fraction),
                      all_columns, stride);
        rings.push_back({fraction, 0.0, stride});
    }
    const double tip_spacing = spacing * kArmSpacingAtTip;
    const auto num_cap_steps =
        std::max(2, static_cast<int>(std::lround(0.5 * kPi * kArmTipRadius / tip_spacing)));
    for (int i = 1; i < num_cap_steps; ++i) {
        const double tilt_rad = 0.5 * kPi * i / num_cap_steps;
        choose_stride(2.0 * kPi * kArmTipRadius * std::cos(tilt_rad), tip_spacing, all_columns,
                      stride);
        rings.push_back({1.0, tilt_rad, stride});
    }
    return rings;
}

uint32_t count_vertices(const std::vector<RingPlan>& rings, uint32_t all_columns) {
    uint32_t count = 1;  // the pole
    for (const RingPlan& ring : rings) count += all_columns / ring.stride;
    return count;
}

// Whether columns can be halved often enough to leave no slivers round apex, mouth and tips.
bool halves_well(uint32_t num_columns) {
    constexpr uint32_t kMaxOddPart = 9;
    while (num_columns % 2 == 0) num_columns /= 2;
    return num_columns <= kMaxOddPart;
}

OctopusPlan make_plan(const OctopusSizes& sizes, uint32_t num_columns, double spacing) {
    OctopusPlan plan;
    plan.num_columns = num_columns;
    const uint32_t body_columns = kNumArms * num_columns;
    plan.upper = plan_sheet(sizes.upper_radii, sizes.upper_length, spacing, body_columns);
    plan.lower = plan_sheet(sizes.lower_radii, sizes.lower_length, spacing, body_columns);
    plan.arm = plan_arm(sizes, spacing, 2 * num_columns);
    const uint32_t rim = kNumArms * (2 * num_columns - 1);  // both halves share the arms' corners
    plan.num_vertices = rim + count_vertices(plan.upper, body_columns) +
                        count_vertices(plan.lower, body_columns) +
                        kNumArms * count_vertices(plan.arm, 2 * num_columns);
    return plan;
}

}  // namespace

double arm_ring_share(double fraction) {
    return (1.0 - std::pow(kArmSpacingAtTip, fraction)) / (1.0 - kArmSpacingAtTip);
}

OctopusPlan plan_octopus(const OctopusSizes& sizes, uint32_t num_vertices) {
    OctopusPlan best;
    double best_cost = 1e9;
    for (uint32_t num_columns = 3;; ++num_columns) {
        // The number of vertices grows with the square of the columns. With more columns none of
        // the spacings below fits.
        if (make_plan(sizes, num_columns, 1.25 * kHalfRim / num_columns).num_vertices >
            num_vertices) {
            break;
        }
        if (!halves_well(num_columns)) continue;
        for (int step = -60; step <= 60; ++step) {
            const double stretch = 0.003 * step;
            const OctopusPlan plan =
                make_plan(sizes, num_columns, std::exp(stretch) * kHalfRim / num_columns);
            if (plan.num_vertices > num_vertices) continue;
            const double missing =
                static_cast<double>(num_vertices - plan.num_vertices) / num_vertices;
            const double cost = missing + 0.02 * std::abs(stretch);
            if (cost < best_cost) {
                best_cost = cost;
                best = plan;
            }
        }
    }
    PAIM_CHECK_LT(best_cost, 1e9);
    return best;
}

}  // namespace paim::poses
