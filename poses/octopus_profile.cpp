// Meridians and cross-sections of the octopus at rest, traced on its implicit surface.
#include "poses/octopus_profile.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "poses/octopus_shape.h"

namespace paim::poses {

namespace {

using Vec2d = Eigen::Vector2d;

constexpr size_t kNumOffsets = 33;     // meridians between the arm's middle and the sector's edge
constexpr size_t kNumFractions = 257;  // points on each

// The distance from `inside` along the unit direction, up to `length`, at which the field changes
// sign.
double crossing(const Vec3d& inside, const Vec3d& direction, double length) {
    double low = 0.0, high = length;
    if (octopus_body(inside + high * direction).value <= 0.0) return high;
    for (int i = 0; i < 52; ++i) {
        const double middle = 0.5 * (low + high);
        (octopus_body(inside + middle * direction).value <= 0.0 ? low : high) = middle;
    }
    return low;
}

// Direction at an azimuth offset from the axis of arm 0.
Vec3d radial(double offset_rad) {
    const ArmAxes axes = arm_axes(0);
    return std::cos(offset_rad) * axes.outward + std::sin(offset_rad) * axes.lateral;
}

// The surface's curve in one meridian plane, from the axis to the rim, in steps of about 0.005.
std::vector<Vec2d> trace(double offset_rad, Sheet::Side side) {
    const Vec3d out = radial(offset_rad);
    const double up = side == Sheet::Side::upper ? 1.0 : -1.0;
    const double rim = rim_s() / std::cos(offset_rad);
    const auto field = [&](const Vec2d& point) {
        const FieldValue value = octopus_body(point.x() * out + point.y() * Vec3d::UnitY());
        return std::pair{value.value, Vec2d(value.gradient.dot(out), value.gradient.y())};
    };
    constexpr double kCurveStep = 0.005;
    std::vector<Vec2d> curve{{0.0, up * crossing(Vec3d::Zero(), up * Vec3d::UnitY(), 5.0)}};
    Vec2d heading(1.0, 0.0);
    while (true) {
        const Vec2d gradient = field(curve.back()).second;
        Vec2d tangent = Vec2d(gradient.y(), -gradient.x()).normalized();
        if (tangent.dot(heading) < 0.0) tangent = -tangent;
        Vec2d next = curve.back() + kCurveStep * tangent;
        for (int i = 0; i < 4; ++i) {
            const auto [value, slope] = field(next);
            next -= value / slope.squaredNorm() * slope;
        }
        heading = (next - curve.back()).normalized();
        // The end is where the curve reaches the rim's plane, or on the web turns to the other
        // sheet.
        const bool on_skirt = up * next.y() < 0.7;
        if ((on_skirt && heading.x() > 0.0 && next.x() >= rim) || up * next.y() <= 0.0) break;
        curve.push_back(next);
        PAIM_CHECK_LT(curve.size(), size_t{10000});
    }
    return curve;
}

double curve_length(const std::vector<Vec2d>& curve) {
    double length = 0.0;
    for (size_t i = 1; i < curve.size(); ++i) length += (curve[i] - curve[i - 1]).norm();
    return length;
}

// Points at equal distances along the curve.
std::vector<Vec2d> resample(const std::vector<Vec2d>& curve, size_t num_points) {
    const double length = curve_length(curve);
    std::vector<Vec2d> points{curve.front()};
    double passed = 0.0;
    for (size_t i = 1; i < curve.size() && points.size() < num_points - 1; ++i) {
        const double piece = (curve[i] - curve[i - 1]).norm();
        while (points.size() < num_points - 1) {
            const double wanted =
                length * static_cast<double>(points.size()) / static_cast<double>(num_points - 1);
            if (wanted > passed + piece) break;
            points.push_back(curve[i - 1] + (wanted - passed) / piece * (curve[i] - curve[i - 1]));
        }
        passed += piece;
    }
    points.resize(num_points, curve.back());
    return points;
}

}  // namespace

double rim_s() {
    static const double s = [] {
        const double half_sector = 0.5 * kSector_rad;
        return crossing(Vec3d::Zero(), radial(half_sector), 3.0) * std::cos(half_sector);
    }();
    return s;
}

Vec3d arm_surface(double s, double turn_rad, double tilt_rad) {
    const ArmAxes axes = arm_axes(0);
    const double lateral = std::cos(tilt_rad) * std::cos(turn_rad);
    const double up = std::cos(tilt_rad) * std::sin(turn_rad);
    const double outward = std::sin(tilt_rad);
    const double half_gap = s * std::tan(0.5 * kSector_rad);
    const double length = half_gap < 1.0 * std::abs(lateral) ? half_gap / std::abs(lateral) : 1.0;
    const double t =
        crossing(s * axes.outward,
                 lateral * axes.lateral + up * Vec3d::UnitY() + outward * axes.outward, length);
    return {s + t * outward, t * up, t * lateral};
}

Sheet::Sheet(Side side) {
    for (size_t i = 0; i < kNumOffsets; ++i) {
        const double offset_rad =
            0.5 * kSector_rad * static_cast<double>(i) / static_cast<double>(kNumOffsets - 1);
        const auto curve = trace(offset_rad, side);
        if (i == 0) length_ = curve_length(curve);
        meridians_.push_back(resample(curve, kNumFractions));
    }
}

Eigen::Vector2d Sheet::at(double offset_rad, double fraction) const {
    const auto locate = [](double x, size_t count) {
        const double scaled = std::clamp(x, 0.0, 1.0) * static_cast<double>(count - 1);
        const auto index = std::min(static_cast<size_t>(scaled), count - 2);
        return std::pair{index, scaled - static_cast<double>(index)};
    };
    const auto [i, a] = locate(std::abs(offset_rad) / (0.5 * kSector_rad), kNumOffsets);
    const auto [j, b] = locate(fraction, kNumFractions);
    return (1 - a) * ((1 - b) * meridians_[i][j] + b * meridians_[i][j + 1]) +
           a * ((1 - b) * meridians_[i + 1][j] + b * meridians_[i + 1][j + 1]);
}

}  // namespace paim::poses
