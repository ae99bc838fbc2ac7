// Triangulates polygons, once for all poses.
// Based on: G. H. Meisters, Polygons Have Ears, 1975
#include "compressor/io/triangulate.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"

namespace paim {

namespace {

using Vec2d = Eigen::Vector2d;
using Corners = std::vector<uint32_t>;

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

// Triangulates one polygon at a time, with scratch memory that is reused.
class Cutter {
  public:
    explicit Cutter(std::vector<Triangle>& triangles) : triangles_(triangles) {}

    // Returns false if the polygon is degenerate; it is triangulated in any case.
    bool cut(const Corners& corners, std::span<const Vec3f> positions) {
        corners_ = &corners;
        points_.clear();
        // Coordinates relative to the first corner, scaled to unit size, so that products neither
        // underflow nor overflow.
        const Vec3d origin = positions[corners[0]].cast<double>();
        double extent = 0.0, magnitude = 0.0;
        for (const uint32_t v : corners) {
            points_.push_back(positions[v].cast<double>() - origin);
            extent = std::max(extent, points_.back().cwiseAbs().maxCoeff());
            magnitude = std::max(magnitude, double{positions[v].cwiseAbs().maxCoeff()});
        }
        if (extent > 0.0) {
            for (Vec3d& point : points_) point /= extent;
        }
        // The rounding of coordinates to float, in these units.
        tolerance_ = extent > 0.0 ? 0x1p-24 * magnitude / extent : 0.0;

        if (corners.size() == 3) {
            emit(0, 1, 2);
            return true;  // a triangle needs no cut, with or without area
        }
        return corners.size() == 4 ? cut_quad() : cut_polygon();
    }

  private:
    void emit(size_t a, size_t b, size_t c) {
        triangles_.push_back({(*corners_)[a], (*corners_)[b], (*corners_)[c]});
    }

    bool cut_quad() {
        const Vec3d normal = newell_normal(points_);
        const auto faces_along = [&](size_t a, size_t b, size_t c) {
            return (points_[b] - points_[a]).cross(points_[c] - points_[a]).dot(normal) > 0.0;
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

    bool cut_polygon() {
        remaining_.clear();
        for (size_t i = 0; i < points_.size(); ++i) remaining_.push_back(i);
        const bool has_area = project();
        // Nearly straight corners are clipped only if no others are left.
        bool clipped = has_area && (clip_ears(4.0 * tolerance_) || clip_ears(0.0));
        if (!clipped) {
            for (size_t i = 1; i + 1 < remaining_.size(); ++i) {
                emit(remaining_[0], remaining_[i], remaining_[i + 1]);
            }
        }
        return clipped;
    }

    // Projects into the plane of the Newell normal, counter-clockwise. Returns false without area.
    bool project() {
        const Vec3d normal = newell_normal(points_);
        const double length = normal.norm();
        if (length <= 1e-15) return false;  // rounding of the cross products
        const Vec3d u = normal.unitOrthogonal();
        const Vec3d v = (normal / length).cross(u);
        flat_.clear();
        for (const Vec3d& point : points_) flat_.emplace_back(point.dot(u), point.dot(v));
        return true;
    }

    // Clips ears until one triangle is left, which is added, too. Returns false if there is no ear.
    // tolerance  areas up to this count as zero
    bool clip_ears(double tolerance) {
        is_ear_.clear();
        for (size_t i = 0; i < remaining_.size(); ++i) is_ear_.push_back(test_ear(i, tolerance));
        size_t at = 0;
        bool fresh = true;  // every entry of is_ear_ was tested against the remaining polygon
        while (remaining_.size() > 3) {
            const size_t num = remaining_.size();
            size_t steps = 0;
            while (steps < num && !is_ear_[at]) {
                at = at + 1 < num ? at + 1 : 0;
                ++steps;
            }
            if (steps == num) {
                if (fresh) return false;
                for (size_t i = 0; i < num; ++i) is_ear_[i] = test_ear(i, tolerance);
                fresh = true;
                continue;
            }
            emit(remaining_[before(at)], remaining_[at], remaining_[after(at)]);
            remaining_.erase(remaining_.begin() + static_cast<std::ptrdiff_t>(at));
            is_ear_.erase(is_ear_.begin() + static_cast<std::ptrdiff_t>(at));
            if (at == remaining_.size()) at = 0;
            // In a simple polygon only these two corners change.
            is_ear_[at] = test_ear(at, tolerance);
            is_ear_[before(at)] = test_ear(before(at), tolerance);
            fresh = false;
        }
        emit(remaining_[0], remaining_[1], remaining_[2]);
        return true;
    }

    uint32_t vertex(size_t i) const { return (*corners_)[remaining_[i]]; }
    size_t before(size_t i) const { return i > 0 ? i - 1 : remaining_.size() - 1; }
    size_t after(size_t i) const { return i + 1 < remaining_.size() ? i + 1 : 0; }

    // Whether corner i is an ear: it is convex, and no corner that is not convex lies in its
    // triangle or on its edges. A triangle that names a vertex twice (a spike, or the rest of a
    // bridge) is an ear.
    bool test_ear(size_t i, double tolerance) const {
        const uint32_t v_before = vertex(before(i)), v_here = vertex(i), v_after = vertex(after(i));
        if (v_before == v_here || v_here == v_after || v_after == v_before) return true;
        const Vec2d& a = flat_[remaining_[before(i)]];
        const Vec2d& b = flat_[remaining_[i]];
        const Vec2d& c = flat_[remaining_[after(i)]];
        if (cross(a, b, c) <= tolerance) return false;
        for (size_t k = 0; k < remaining_.size(); ++k) {
            const Vec2d& p = flat_[remaining_[k]];
            if (p == a || p == b || p == c) continue;  // also the other end of a bridge to a hole
            if (cross(a, b, p) < -tolerance || cross(b, c, p) < -tolerance ||
                cross(c, a, p) < -tolerance) {
                continue;
            }
            if (cross(flat_[remaining_[before(k)]], p, flat_[remaining_[after(k)]]) <= tolerance) {
                return false;
            }
        }
        return true;
    }

    std::vector<Triangle>& triangles_;
    const Corners* corners_ = nullptr;
    std::vector<Vec3d> points_;
    std::vector<Vec2d> flat_;
    std::vector<size_t> remaining_;
    std::vector<char> is_ear_;
    double tolerance_ = 0.0;
};

bool repeats_vertex(Corners corners) {
    std::sort(corners.begin(), corners.end());
    return std::adjacent_find(corners.begin(), corners.end()) != corners.end();
}

// Removes corners that are the same vertex as the one before.
void merge_neighbours(Corners& corners) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
}

}  // namespace

Triangulation triangulate(const Polygons& polygons, std::span<const Vec3f> positions) {
    Triangulation result;
    std::vector<Triangle>& triangles = result.triangles;
    Cutter cutter(triangles);
    Corners corners;
    size_t first_corner = 0;
    for (const uint8_t size : polygons.sizes) {
        const auto begin = polygons.corners.begin() + static_cast<std::ptrdiff_t>(first_corner);
        corners.assign(begin, begin + size);
        first_corner += size;
        for (const uint32_t v : corners) PAIM_CHECK_LT(v, positions.size());

        const bool repeats = repeats_vertex(corners);
        if (repeats) {
            ++result.num_repeating;
            merge_neighbours(corners);
            if (corners.size() < 3) continue;
        }
        const size_t first_triangle = triangles.size();
        if (!cutter.cut(corners, positions)) ++result.num_degenerate;
        if (repeats) {
            const auto new_ones = triangles.begin() + static_cast<std::ptrdiff_t>(first_triangle);
            triangles.erase(std::remove_if(new_ones, triangles.end(),
                                           [](const Triangle& t) {
                                               return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
                                           }),
                            triangles.end());
        }
    }
    return result;
}

}  // namespace paim
