// Cuts one polygon into triangles.
#include "compressor/io/polygon_cutter.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

using Vec2d = Eigen::Vector2d;

constexpr uint32_t kNone = UINT32_MAX;
// Ear clipping takes at most about corners times notches steps, and far fewer with strips. These
// take about a second.
constexpr uint64_t kMaxSteps = uint64_t{1} << 28;
constexpr uint32_t kNotchesInStrip = 8;
// The sine of a turn that is no rounding.
constexpr double kNotchSine = 0.02;

// Twice the area vector of the polygon, of a best-fitting plane if it is not flat. Zero without
// area.
Vec3d newell_normal(const std::vector<Vec3d>& points) {
    Vec3d sum = Vec3d::Zero();
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        sum += (points[i] - points[0]).cross(points[i + 1] - points[0]);
    }
    return sum;
}

// Twice the signed area of a triangle, positive if counter-clockwise.
double cross(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

}  // namespace

void PolygonCutter::set(std::span<const uint32_t> corners, std::span<const Vec3d> points) {
    corners_ = corners;
    points_.clear();
    // Coordinates relative to the first corner, scaled to unit size, so that products neither
    // underflow nor overflow.
    double extent = 0.0, magnitude = 0.0;
    for (const Vec3d& point : points) {
        points_.push_back(point - points[0]);
        extent = std::max(extent, points_.back().cwiseAbs().maxCoeff());
        magnitude = std::max(magnitude, point.cwiseAbs().maxCoeff());
    }
    if (extent > 0.0) {
        for (Vec3d& point : points_) point /= extent;
    }
    extent_ = extent;
    // The rounding of coordinates to float, in these units.
    tolerance_ = extent > 0.0 ? 0x1p-24 * magnitude / extent : 0.0;
    normal_ = newell_normal(points_);
    const double length = normal_.norm();
    area_ = length > 1e-15 ? length : 0.0;  // rounding of the cross products
}

size_t PolygonCutter::num_notches() const {
    if (area_ == 0.0) return 0;
    size_t count = 0;
    for (size_t i = 0; i < points_.size(); ++i) {
        const Vec3d& here = points_[i];
        const Vec3d in = here - points_[i > 0 ? i - 1 : points_.size() - 1];
        const Vec3d out = points_[i + 1 < points_.size() ? i + 1 : 0] - here;
        const double turn = in.cross(out).dot(normal_) / area_;
        if (turn < -kNotchSine * in.norm() * out.norm()) ++count;
    }
    return count;
}

bool PolygonCutter::cut(std::vector<Triangle>& triangles) {
    triangles_ = &triangles;
    if (points_.size() == 3) {
        emit(0, 1, 2);
        return true;  // a triangle needs no cut, with or without area
    }
    return points_.size() == 4 ? cut_quad() : cut_large();
}

void PolygonCutter::emit(uint32_t a, uint32_t b, uint32_t c) {
    triangles_->push_back({corners_[a], corners_[b], corners_[c]});
}

bool PolygonCutter::cut_quad() {
    const auto faces_along = [&](size_t a, size_t b, size_t c) {
        return (points_[b] - points_[a]).cross(points_[c] - points_[a]).dot(normal_) > 0.0;
    };
    const bool valid_02 = faces_along(0, 1, 2) && faces_along(0, 2, 3);
    const bool valid_13 = faces_along(0, 1, 3) && faces_along(1, 2, 3);
    const double length_02 = (points_[2] - points_[0]).norm();
    const double length_13 = (points_[3] - points_[1]).norm();
    const bool shorter_13 = length_13 < length_02 * (1.0 - 1e-5);
    if (valid_02 == valid_13 ? shorter_13 : valid_13) {
        emit(0, 1, 3);
        emit(1, 2, 3);
    } else {
        emit(0, 1, 2);
        emit(0, 2, 3);
    }
    return valid_02 || valid_13;
}

bool PolygonCutter::cut_large() {
    const auto size = static_cast<uint32_t>(points_.size());
    before_.resize(size);
    after_.resize(size);
    for (uint32_t i = 0; i < size; ++i) {
        before_[i] = i > 0 ? i - 1 : size - 1;
        after_[i] = i + 1 < size ? i + 1 : 0;
    }
    first_ = 0;
    num_left_ = size;
    steps_left_ = kMaxSteps;
    // Nearly straight corners are clipped only if no others are left.
    const bool clipped = project() && (clip_ears(4.0 * tolerance_) || clip_ears(0.0));
    if (!clipped) emit_fan();
    return clipped;
}

void PolygonCutter::emit_fan() {
    for (uint32_t i = after_[first_]; after_[i] != first_; i = after_[i]) {
        emit(first_, i, after_[i]);
    }
}

// Projects into the plane of the Newell normal, counter-clockwise. Returns false without area.
bool PolygonCutter::project() {
    if (area_ == 0.0) return false;
    const Vec3d u = normal_.unitOrthogonal();
    const Vec3d v = (normal_ / area_).cross(u);
    flat_.clear();
    for (const Vec3d& point : points_) flat_.emplace_back(point.dot(u), point.dot(v));
    return true;
}

// Clips ears until one triangle is left, which is added, too. Returns false if there is no ear.
// tolerance  areas up to this count as zero
bool PolygonCutter::clip_ears(double tolerance) {
    is_ear_.assign(points_.size(), 0);
    uint32_t at = first_;
    const auto for_all = [&](const auto& use) {
        for (uint32_t k = 0, i = first_; k < num_left_; ++k, i = after_[i]) use(i);
    };
    place_strips(tolerance);
    for_all([&](uint32_t i) { set_notch(i, is_notch(i, tolerance)); });
    for_all([&](uint32_t i) { is_ear_[i] = is_ear(i, tolerance); });
    bool fresh = true;  // every entry of is_ear_ was tested against the remaining polygon
    while (num_left_ > 3) {
        uint32_t steps = 0;
        for (; steps < num_left_ && !is_ear_[at]; ++steps) at = after_[at];
        steps_left_ -= std::min<uint64_t>(steps, steps_left_);
        if (steps_left_ == 0) return false;
        if (steps == num_left_) {
            if (fresh) return false;
            for_all([&](uint32_t i) { is_ear_[i] = is_ear(i, tolerance); });
            fresh = true;
            continue;
        }
        emit(before_[at], at, after_[at]);
        remove(at);
        at = after_[at];
        // In a simple polygon only these two corners change.
        set_notch(at, is_notch(at, tolerance));
        set_notch(before_[at], is_notch(before_[at], tolerance));
        is_ear_[at] = is_ear(at, tolerance);
        is_ear_[before_[at]] = is_ear(before_[at], tolerance);
        fresh = false;
    }
    emit(first_, after_[first_], after_[after_[first_]]);
    return true;
}

// Takes the corner out of the ring. Its own neighbours stay known.
void PolygonCutter::remove(uint32_t i) {
    set_notch(i, false);
    after_[before_[i]] = after_[i];
    before_[after_[i]] = before_[i];
    if (first_ == i) first_ = after_[i];
    --num_left_;
}

bool PolygonCutter::is_notch(uint32_t i, double tolerance) const {
    return cross(flat_[before_[i]], flat_[i], flat_[after_[i]]) <= tolerance;
}

// Empties the strips, and makes as many as there are notches for.
void PolygonCutter::place_strips(double tolerance) {
    notch_at_.assign(points_.size(), kNone);
    Vec2d lower = flat_[first_], upper = lower;
    uint32_t num_notches = 0;
    for (uint32_t k = 0, i = first_; k < num_left_; ++k, i = after_[i]) {
        if (is_notch(i, tolerance)) ++num_notches;
        lower = lower.cwiseMin(flat_[i]);
        upper = upper.cwiseMax(flat_[i]);
    }
    across_ = upper.x() - lower.x() > upper.y() - lower.y() ? 0 : 1;
    const double size = upper[across_] - lower[across_];
    num_strips_ = 1 + num_notches / kNotchesInStrip;
    strip_begin_ = lower[across_];
    strips_per_unit_ = size > 0.0 ? num_strips_ / size : 0.0;
    if (strips_.size() < num_strips_) strips_.resize(num_strips_);
    for (uint32_t i = 0; i < num_strips_; ++i) strips_[i].clear();
}

uint32_t PolygonCutter::strip_of(double coordinate) const {
    const double strip = (coordinate - strip_begin_) * strips_per_unit_;
    if (!(strip > 0.0)) return 0;
    return strip < num_strips_ ? static_cast<uint32_t>(strip) : num_strips_ - 1;
}

// Notes whether the corner is a notch.
void PolygonCutter::set_notch(uint32_t i, bool is) {
    uint32_t& at = notch_at_[i];
    if (is == (at != kNone)) return;
    std::vector<uint32_t>& strip = strips_[strip_of(flat_[i][across_])];
    if (is) {
        at = static_cast<uint32_t>(strip.size());
        strip.push_back(i);
    } else {
        notch_at_[strip.back()] = at;
        strip[at] = strip.back();
        strip.pop_back();
        at = kNone;
    }
}

// Whether corner i is an ear: it is convex, and no corner that is not convex lies in its triangle
// or on its edges. A triangle that names a vertex twice (a spike, or the rest of a bridge) is an
// ear.
bool PolygonCutter::is_ear(uint32_t i, double tolerance) {
    if (steps_left_ == 0) return false;
    const uint32_t v_before = corners_[before_[i]], v_after = corners_[after_[i]];
    if (v_before == corners_[i] || corners_[i] == v_after || v_after == v_before) return true;
    if (notch_at_[i] != kNone) return false;
    const Vec2d& a = flat_[before_[i]];
    const Vec2d& b = flat_[i];
    const Vec2d& c = flat_[after_[i]];
    const auto [least, greatest] = std::minmax({a[across_], b[across_], c[across_]});
    // With the tolerance, each barycentric coordinate may be as far below zero as tolerance / area.
    const double margin = (2.0 * tolerance / cross(a, b, c) + 1e-9) * (greatest - least);
    const uint32_t end = strip_of(greatest + margin);
    for (uint32_t strip = strip_of(least - margin); strip <= end; ++strip) {
        if (--steps_left_ == 0) return false;
        for (const uint32_t k : strips_[strip]) {
            const Vec2d& p = flat_[k];
            if (p == a || p == b || p == c) continue;  // also the other end of a bridge to a hole
            if (--steps_left_ == 0) return false;
            if (cross(a, b, p) >= -tolerance && cross(b, c, p) >= -tolerance &&
                cross(c, a, p) >= -tolerance) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace paim
