// The octopus' loop: travelling waves along the arms, curling tips, a breathing mantle.
#include "poses/octopus_motion.h"

#include <algorithm>
#include <cmath>

#include "poses/smoothstep.h"

namespace paim::poses {

namespace {

constexpr size_t kNumSections = 513;
constexpr double kSectionsEnd = 5.25;  // distance of the last section, beyond the cap of the tip
constexpr double kStep = kSectionsEnd / (kNumSections - 1);

constexpr double kStandingHeight = 1.45;  // of the arms' roots above the ground
constexpr double kBob = 0.05;

// A number in 0 … 1 that differs from arm to arm without a visible pattern.
double variety(int arm, int aspect) {
    constexpr std::array<double, kNumArms> kValues{0.15, 0.80, 0.45, 1.00, 0.30, 0.65, 0.00, 0.55};
    return kValues[static_cast<size_t>((arm * 3 + aspect * 5) % kNumArms)];
}

// The bend of arm k's axis at distance s, at a moment of the loop. All terms vanish at the body.
// Each has one whole period a loop, so that the loop closes.
ArmBend bend(int arm, double s, double phase_rad) {
    const double own_rad = 2.0 * kPi * (3.0 * arm / kNumArms + 0.1 * variety(arm, 0));
    // The arm goes down from the web, then out along the ground.
    const double posture = -1.08 * smoothstep(0.72, 1.75, s) +
                           (1.02 + 0.1 * variety(arm, 1)) * smoothstep(1.5, 2.75, s);
    // Waves travel outwards and grow on their way.
    const double wave_ramp = smoothstep(1.0, 2.8, s);
    const double wave = 0.42 * wave_ramp * std::sin(2.1 * s - phase_rad + own_rad);
    const double sway =
        0.62 * smoothstep(0.9, 2.6, s) * std::sin(1.5 * s - phase_rad + own_rad + 1.9) +
        0.16 * smoothstep(0.8, 1.6, s) * std::sin(phase_rad + 2.0 * own_rad);
    // The tips roll up into a logarithmic spiral, by an amount that follows the wave.
    const double rolled = 0.66 + 0.34 * std::sin(phase_rad - own_rad - 0.9);
    constexpr double kRollLength = 2.45,
                     kBeyondTip = 0.38;  // the spiral's centre lies beyond the tip
    const double left = std::max(kArmLength + kBeyondTip - s, 0.05);
    const double roll = (2.2 + 0.5 * variety(arm, 2)) *
                        smoothstep(kArmLength + kBeyondTip - kRollLength, 4.2, s) *
                        std::max(std::log(kRollLength / left), 0.0);
    const double aside = 0.2 * (2.0 * variety(arm, 3) - 1.0) * smoothstep(2.6, 4.7, s);
    // Rolled tips leave their plane, as a corkscrew does, so that they miss their own arm.
    const double skew = 0.75 * std::min(0.5 * rolled * roll, 1.0);
    return {posture + wave + rolled * roll, sway + aside, skew};
}

}  // namespace

ArmCurve::ArmCurve(int arm, double phase_rad) : axes_(arm_axes(arm)) {
    // Simpson's rule on the direction between sections.
    Vec3d center = Vec3d::Zero();
    for (size_t i = 0; i < kNumSections; ++i) {
        const double s = static_cast<double>(i) * kStep;
        const ArmBend here = bend(arm, s, phase_rad);
        if (i > 0) {
            const ArmBend middle = bend(arm, s - 0.5 * kStep, phase_rad);
            center += kStep / 6.0 *
                      (frame(sections_.back().bend).col(0) + 4.0 * frame(middle).col(0) +
                       frame(here).col(0));
        }
        sections_.push_back({center, here});
    }
}

Eigen::Matrix3d ArmCurve::frame(const ArmBend& bend) const {
    const Vec3d level =
        std::cos(bend.yaw_rad) * axes_.outward + std::sin(bend.yaw_rad) * axes_.lateral;
    const Vec3d side =
        std::cos(bend.yaw_rad) * axes_.lateral - std::sin(bend.yaw_rad) * axes_.outward;
    const double cosine = std::cos(bend.pitch_rad), sine = std::sin(bend.pitch_rad);
    const Vec3d along = cosine * level + sine * Vec3d::UnitY();
    Eigen::Matrix3d frame;
    frame.col(0) = std::cos(bend.skew_rad) * along + std::sin(bend.skew_rad) * side;
    frame.col(1) = cosine * Vec3d::UnitY() - sine * level;
    frame.col(2) = std::cos(bend.skew_rad) * side - std::sin(bend.skew_rad) * along;
    return frame;
}

Vec3d ArmCurve::place(double s, double up, double lateral) const {
    const double scaled = std::clamp(s / kStep, 0.0, static_cast<double>(kNumSections - 1));
    const auto i = std::min(static_cast<size_t>(scaled), kNumSections - 2);
    const double t = scaled - static_cast<double>(i);
    const Section &a = sections_[i], &b = sections_[i + 1];
    const auto mix = [t](double from, double to) { return from + t * (to - from); };
    const Eigen::Matrix3d here =
        frame({mix(a.bend.pitch_rad, b.bend.pitch_rad), mix(a.bend.yaw_rad, b.bend.yaw_rad),
               mix(a.bend.skew_rad, b.bend.skew_rad)});
    // Cubic through both sections with their directions.
    const double t2 = t * t, t3 = t2 * t;
    const Vec3d center = (2 * t3 - 3 * t2 + 1) * a.center + (3 * t2 - 2 * t3) * b.center +
                         (t3 - 2 * t2 + t) * kStep * frame(a.bend).col(0) +
                         (t3 - t2) * kStep * frame(b.bend).col(0);
    return center + up * here.col(1) + lateral * here.col(2);
}

OctopusMotion::OctopusMotion(double phase_rad) : phase_rad_(phase_rad) {
    for (int arm = 0; arm < kNumArms; ++arm) arms_.emplace_back(arm, phase_rad);
}

Vec3d OctopusMotion::place_on_arms(const Vec3d& rest) const {
    const double azimuth = std::atan2(rest.x(), rest.z()) / kSector_rad;  // in arms
    const double reach = std::hypot(rest.x(), rest.z());
    const auto on_arm = [&](int arm) {
        const double offset_rad = (azimuth - arm - 0.5) * kSector_rad;
        const int index = (arm + 2 * kNumArms) % kNumArms;
        return arms_[static_cast<size_t>(index)].place(reach * std::cos(offset_rad), rest.y(),
                                                       reach * std::sin(offset_rad));
    };
    // Position between the arm's axis (0) and the edges of its sector (±1).
    const int own = static_cast<int>(std::floor(azimuth));
    const double offset_rad = (azimuth - own - 0.5) * kSector_rad;
    const double between = std::tan(offset_rad) / std::tan(0.5 * kSector_rad);
    const double others = 0.5 * smoothstep(0.4, 1.0, std::abs(between));
    Vec3d placed = on_arm(own);
    if (others > 0.0) {
        placed += others * (on_arm(own + (between > 0.0 ? 1 : -1)) - placed);
    }
    return placed;
}

Vec3d OctopusMotion::place_body(const Vec3d& rest) const {
    // Breathing widens the mantle; nodding bends the neck back and to the side.
    const double mantle = smoothstep(0.9, 2.2, rest.y());
    const double breath = 1.0 + 0.045 * mantle * std::sin(phase_rad_ + 0.6);
    Vec3d placed(rest.x() * breath, rest.y(), rest.z() * breath);
    constexpr double kNeckHeight = 0.9;
    const double bent = smoothstep(0.5, 2.6, rest.y());
    const double back_rad = -bent * (0.42 + 0.06 * std::sin(phase_rad_));
    const double side_rad = bent * 0.08 * std::sin(phase_rad_ + 1.3);
    placed.y() -= kNeckHeight;
    placed = Eigen::AngleAxisd(side_rad, Vec3d::UnitZ()) *
             (Eigen::AngleAxisd(back_rad, Vec3d::UnitX()) * placed);
    placed.y() += kNeckHeight;
    return placed;
}

Vec3d OctopusMotion::place(const Vec3d& rest) const {
    const double body = smoothstep(0.25, 0.75, rest.y());
    Vec3d placed = Vec3d::Zero();
    if (body > 0.0) placed += body * place_body(rest);
    if (body < 1.0) placed += (1.0 - body) * place_on_arms(rest);
    placed.y() += kStandingHeight + kBob * std::sin(phase_rad_);
    return placed;
}

}  // namespace paim::poses
