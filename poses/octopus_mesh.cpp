// The mesh of the octopus at rest: sheets and tubes of rings, evened out on the surface.
#include "poses/octopus_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/check.h"
#include "poses/mesh_refine.h"
#include "poses/octopus_plan.h"
#include "poses/octopus_profile.h"
#include "poses/octopus_shape.h"
#include "poses/ring_mesh.h"
#include "poses/smoothstep.h"

namespace paim::poses {

namespace {

std::vector<double> radii(const Sheet& sheet) {
    constexpr int kNumSteps = 256;
    std::vector<double> all;
    for (int i = 0; i <= kNumSteps; ++i) {
        all.push_back(sheet.at(0.0, static_cast<double>(i) / kNumSteps).x());
    }
    return all;
}

class Builder {
  public:
    explicit Builder(uint32_t num_vertices)
        : upper_(Sheet::Side::upper), lower_(Sheet::Side::lower) {
        plan_ = plan_octopus(
            {radii(upper_), radii(lower_), upper_.length(), lower_.length(), kArmLength - rim_s()},
            num_vertices);
    }

    RestMesh build() {
        make_rims();
        make_sheet(upper_, plan_.upper, upper_rim_, 1.0);
        make_sheet(lower_, plan_.lower, lower_rim_, -1.0);
        for (uint32_t arm = 0; arm < kNumArms; ++arm) make_arm(arm);
        mesh_.topology.num_vertices = static_cast<uint32_t>(mesh_.positions.size());
        PAIM_CHECK_EQ(mesh_.topology.num_vertices, plan_.num_vertices);
        return std::move(mesh_);
    }

  private:
    uint32_t add(const Vec3d& position) {
        mesh_.positions.push_back(position);
        return static_cast<uint32_t>(mesh_.positions.size() - 1);
    }

    // Point (s, up, lateral) of an arm's frame.
    static Vec3d in_arm(uint32_t arm, const Vec3d& local) {
        const ArmAxes axes = arm_axes(static_cast<int>(arm));
        return local.x() * axes.outward + local.y() * Vec3d::UnitY() + local.z() * axes.lateral;
    }

    // Column j = 0 … n of a sector, from its lower to its higher azimuth: the rim's point in the
    // arm's frame. Columns 0 and n are the web's corners, which both halves share.
    Vec3d rim_point(uint32_t j, double half) const {
        const double turn_rad = kPi * (1.0 - static_cast<double>(j) / plan_.num_columns);
        return arm_surface(rim_s(), half * turn_rad, 0.0);
    }

    void make_rims() {
        const uint32_t n = plan_.num_columns;
        for (uint32_t arm = 0; arm < kNumArms; ++arm) {
            for (uint32_t j = 0; j < n; ++j) {
                upper_rim_.push_back(add(in_arm(arm, rim_point(j, 1.0))));
                lower_rim_.push_back(j == 0 ? upper_rim_.back()
                                            : add(in_arm(arm, rim_point(j, -1.0))));
            }
        }
    }

    void make_sheet(const Sheet& sheet, const std::vector<RingPlan>& rings, const Ring& rim,
                    double half) {
        const uint32_t n = plan_.num_columns;
        std::vector<double> rim_offset_rad;
        for (uint32_t j = 0; j < n; ++j) {
            const Vec3d local = rim_point(j, half);
            rim_offset_rad.push_back(std::atan2(local.z(), local.x()));
        }
        const Facing facing = half > 0.0 ? Facing::outward : Facing::inward;
        auto& triangles = mesh_.topology.triangles;
        Ring outer = rim;
        for (const RingPlan& ring : rings) {
            Ring inner;
            // Columns are spread evenly near the axis and follow the rim's points at the rim.
            const double at_rim = smoothstep(0.5, 1.0, ring.fraction);
            for (uint32_t column = 0; column < kNumArms * n; column += ring.stride) {
                const double even_rad = kSector_rad * (static_cast<double>(column % n) / n - 0.5);
                const double offset_rad =
                    even_rad + at_rim * (rim_offset_rad[column % n] - even_rad);
                const Eigen::Vector2d point = sheet.at(offset_rad, ring.fraction);
                inner.push_back(add(in_arm(column / n, {point.x() * std::cos(offset_rad), point.y(),
                                                        point.x() * std::sin(offset_rad)})));
            }
            stitch_rings(outer, inner, facing, triangles);
            outer = std::move(inner);
        }
        close_ring(outer, add({0.0, sheet.at(0.0, 0.0).y(), 0.0}), facing, triangles);
    }

    void make_arm(uint32_t arm) {
        const uint32_t n = plan_.num_columns;
        const uint32_t first = arm * n, next = (arm + 1) % kNumArms * n;
        Ring outer{upper_rim_[next]};  // column m turns by πm/n from lateral over up
        for (uint32_t j = n - 1; j > 0; --j) outer.push_back(upper_rim_[first + j]);
        outer.push_back(upper_rim_[first]);
        for (uint32_t j = 1; j < n; ++j) outer.push_back(lower_rim_[first + j]);
        auto& triangles = mesh_.topology.triangles;
        for (const RingPlan& ring : plan_.arm) {
            const double s = rim_s() + (kArmLength - rim_s()) * arm_ring_share(ring.fraction);
            Ring inner;
            for (uint32_t m = 0; m < 2 * n; m += ring.stride) {
                inner.push_back(add(in_arm(arm, arm_surface(s, kPi * m / n, ring.tilt_rad))));
            }
            stitch_rings(outer, inner, Facing::outward, triangles);
            outer = std::move(inner);
        }
        close_ring(outer, add(in_arm(arm, arm_surface(kArmLength, 0.0, 0.5 * kPi))),
                   Facing::outward, triangles);
    }

    Sheet upper_, lower_;
    OctopusPlan plan_;
    Ring upper_rim_, lower_rim_;
    RestMesh mesh_;
};

}  // namespace

RestMesh make_rest_octopus(uint32_t num_vertices) {
    // The last vertices go where they are needed most, a part at a time: eyes, then long edges.
    constexpr uint32_t kMinIrregular = 90, kIrregularPart = 32, kNumRounds = 3;
    const uint32_t irregular = std::max(kMinIrregular, num_vertices / kIrregularPart);
    RestMesh mesh = Builder(num_vertices - irregular).build();
    for (Vec3d& position : mesh.positions) position = lift_to_eyes(position);
    for (uint32_t round = 0; round < kNumRounds; ++round) {
        relax(mesh.topology, 3, project_to_octopus, mesh.positions);
        const uint32_t missing = num_vertices - mesh.topology.num_vertices;
        split_longest_edges(missing / (kNumRounds - round), octopus_fineness, mesh.topology,
                            mesh.positions);
        flip_edges(2, mesh.positions, mesh.topology);
    }
    relax(mesh.topology, 4, project_to_octopus, mesh.positions);
    flip_edges(2, mesh.positions, mesh.topology);
    relax(mesh.topology, 2, project_to_octopus, mesh.positions);
    return mesh;
}

}  // namespace paim::poses
