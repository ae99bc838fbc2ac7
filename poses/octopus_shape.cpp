// The octopus at rest as an implicit surface.
// Based on: Quílez, Distance functions and smooth minimum (round cones; exponential smooth minimum)
#include "poses/octopus_shape.h"

#include <algorithm>
#include <cmath>

#include "poses/smoothstep.h"

namespace paim::poses {

namespace {

constexpr double kArmStart = 0.45;        // distance of the arms' first sphere from the axis
constexpr double kArmStartRadius = 0.38;  // radius of that sphere
constexpr double kBodyBlend = 0.15;       // width of the fillets between mantle, head and arms
constexpr double kEyeBlend = 0.05;

// Eyes sit on the head, a little above its middle.
constexpr double kEyeAzimuth_rad = 0.62;
constexpr double kEyeAxisDistance = 0.72;
constexpr double kEyeHeight = 1.12;
constexpr double kEyeRadius = 0.25;

FieldValue sphere(const Vec3d& point, const Vec3d& center, double radius) {
    const Vec3d offset = point - center;
    const double distance = std::max(offset.norm(), 1e-12);
    return {distance - radius, offset / distance};
}

// Signed distance of the hull of two spheres on a line.
FieldValue round_cone(const Vec3d& point, const Vec3d& start, const Vec3d& direction, double length,
                      double start_radius, double end_radius) {
    const Vec3d offset = point - start;
    const double along = offset.dot(direction);
    const Vec3d across = offset - along * direction;
    const double off_axis = std::max(across.norm(), 1e-12);
    const double slope = (start_radius - end_radius) / length;
    const double cosine = std::sqrt(1.0 - slope * slope);
    const double position = along * cosine - off_axis * slope;
    if (position < 0.0) return sphere(point, start, start_radius);
    if (position > cosine * length) return sphere(point, start + length * direction, end_radius);
    return {off_axis * cosine + along * slope - start_radius,
            across / off_axis * cosine + slope * direction};
}

// Smooth minimum −k log Σ exp(−d/k), which does not depend on the order of its parts.
template <size_t N>
FieldValue smooth_union(const std::array<FieldValue, N>& parts, double blend) {
    double nearest = parts[0].value;
    for (const FieldValue& part : parts) nearest = std::min(nearest, part.value);
    double sum = 0.0;
    Vec3d gradient = Vec3d::Zero();
    for (const FieldValue& part : parts) {
        const double weight = std::exp((nearest - part.value) / blend);
        sum += weight;
        gradient += weight * part.gradient;
    }
    return {nearest - blend * std::log(sum), gradient / sum};
}

Vec3d eye_center(double side) {
    return {side * std::sin(kEyeAzimuth_rad) * kEyeAxisDistance, kEyeHeight,
            std::cos(kEyeAzimuth_rad) * kEyeAxisDistance};
}

// 1 on the suckers, 0 between them: two staggered rows below each arm, as far apart as it is thick.
double sucker(const Vec3d& point) {
    const double azimuth = std::atan2(point.x(), point.z()) / kSector_rad;
    const double offset_rad = (azimuth - std::floor(azimuth) - 0.5) * kSector_rad;
    const double reach = std::hypot(point.x(), point.z());
    const double s = reach * std::cos(offset_rad), lateral = reach * std::sin(offset_rad);
    // Steps that shrink with the arm are equal on a logarithmic scale.
    const double slope = (kArmStartRadius - kArmTipRadius) / (kArmLength - kArmStart);
    const double row = lateral > 0.0 ? 0.0 : 0.5;
    const double steps = -std::log(arm_radius(s)) / (0.9 * slope) + row;
    const double along = 0.9 * (steps - std::round(steps));
    const double across = std::abs(lateral) / arm_radius(s) - 0.42;
    const double on_arm = smoothstep(1.1, 1.6, s) * (1.0 - smoothstep(4.3, 4.8, s));
    return on_arm * (1.0 - smoothstep(0.17, 0.36, std::hypot(along, across)));
}

}  // namespace

ArmAxes arm_axes(int arm) {
    const double azimuth_rad = (arm + 0.5) * kSector_rad;
    const double sine = std::sin(azimuth_rad), cosine = std::cos(azimuth_rad);
    return {{sine, 0.0, cosine}, {cosine, 0.0, -sine}};
}

double arm_radius(double s) {
    const double t = std::clamp((s - kArmStart) / (kArmLength - kArmStart), 0.0, 1.0);
    return kArmStartRadius + t * (kArmTipRadius - kArmStartRadius);
}

FieldValue octopus_body(const Vec3d& point) {
    static const std::array<ArmAxes, kNumArms> axes = [] {
        std::array<ArmAxes, kNumArms> all;
        for (int arm = 0; arm < kNumArms; ++arm) all[static_cast<size_t>(arm)] = arm_axes(arm);
        return all;
    }();
    std::array<FieldValue, kNumArms + 2> parts;
    for (size_t arm = 0; arm < kNumArms; ++arm) {
        parts[arm] = round_cone(point, kArmStart * axes[arm].outward, axes[arm].outward,
                                kArmLength - kArmStart, kArmStartRadius, kArmTipRadius);
    }
    parts[kNumArms] = sphere(point, {0.0, 0.62, 0.0}, 0.6);  // head
    parts[kNumArms + 1] = round_cone(point, {0.0, 1.25, 0.0}, Vec3d::UnitY(), 0.95, 0.62, 0.98);
    return smooth_union(parts, kBodyBlend);
}

FieldValue octopus_field(const Vec3d& point) {
    return smooth_union(std::array{octopus_body(point), sphere(point, eye_center(-1.0), kEyeRadius),
                                   sphere(point, eye_center(1.0), kEyeRadius)},
                        kEyeBlend);
}

Vec3d lift_to_eyes(const Vec3d& point) {
    const Vec3d axis(0.0, kEyeHeight, 0.0);
    double distance = (point - axis).norm();
    const Vec3d direction = (point - axis) / distance;
    for (const double side : {-1.0, 1.0}) {
        const Vec3d center = eye_center(side) - axis;
        const double along = center.dot(direction);
        const double half_squared =
            kEyeRadius * kEyeRadius - (center.squaredNorm() - along * along);
        if (along > 0.0 && half_squared > 0.0) {
            distance = std::max(distance, along + std::sqrt(half_squared));
        }
    }
    return axis + distance * direction;
}

Vec3d project_to_octopus(const Vec3d& point) {
    // Newton's method converges quadratically on a field that is nearly a distance; the steps are
    // short enough never to jump across an arm.
    constexpr int kMaxSteps = 24;
    constexpr double kMaxStep = 0.1;
    Vec3d moved = point;
    for (int step = 0; step < kMaxSteps; ++step) {
        const FieldValue field = octopus_field(moved);
        const double distance =
            std::clamp(field.value / std::max(field.gradient.norm(), 0.2), -kMaxStep, kMaxStep);
        moved -= distance * field.gradient.normalized();
        if (std::abs(distance) < 1e-9) break;
    }
    return moved;
}

double octopus_fineness(const Vec3d& point) {
    constexpr double kFinenessOfEyes = 2.6;
    for (const double side : {-1.0, 1.0}) {
        if ((point - eye_center(side)).norm() < 1.1 * kEyeRadius) return kFinenessOfEyes;
    }
    return 1.0;
}

Vec3f octopus_albedo(const Vec3d& point) {
    const Vec3d coral(0.80, 0.17, 0.10), dusk(0.50, 0.06, 0.07), cream(0.90, 0.55, 0.40),
        rose(0.62, 0.16, 0.13);
    const Vec3d white(0.93, 0.92, 0.88), dark(0.02, 0.015, 0.02);
    const Vec3d up = octopus_field(point).gradient.normalized();

    // Deeper red towards the crown and the arms' tips; the underside of the arms is pale.
    const double reach = std::hypot(point.x(), point.z());
    Vec3d albedo = coral + 0.75 * smoothstep(1.9, 3.4, point.y()) * (dusk - coral) +
                   0.6 * smoothstep(2.0, kArmLength, reach) * (dusk - coral);
    const double below =
        (1.0 - smoothstep(-0.45, 0.15, up.y())) * (1.0 - smoothstep(0.0, 0.25, point.y()));
    albedo += below * (cream - albedo);
    albedo += 0.75 * below * sucker(point) * (rose - albedo);

    for (const double side : {-1.0, 1.0}) {
        const Vec3d center = eye_center(side);
        const Vec3d offset = point - center;
        if (offset.norm() > 1.15 * kEyeRadius) continue;
        // The eyes look outwards and a little to the front.
        const Vec3d gaze =
            Vec3d(side * std::sin(kEyeAzimuth_rad * 0.65), 0.12, std::cos(kEyeAzimuth_rad * 0.65))
                .normalized();
        const double cosine = offset.normalized().dot(gaze);
        albedo += smoothstep(0.42, 0.62, cosine) * (white - albedo);
        albedo += smoothstep(0.76, 0.89, cosine) * (dark - albedo);
    }
    return albedo.cast<float>();
}

}  // namespace paim::poses
