// Cuts one polygon into triangles, by its shape in one pose.
// Based on: G. H. Meisters, Polygons Have Ears, 1975
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/base/vector.h"
#include "paim/mesh/topology.h"

namespace paim {

// Cuts one polygon at a time, with scratch memory that is reused.
//
// Quads are cut along the diagonal for which both triangles face like the quad. If both diagonals
// do, the shorter one is taken; of two equally long ones (to 1e-5, the precision of six printed
// digits) that at the first corner. Larger polygons are cut by ear clipping in the plane of their
// Newell normal.
class PolygonCutter {
  public:
    // Sets the polygon.
    // corners  vertices, at least 3, no two neighbours the same; must outlive the cuts
    // points   [corners] positions, finite; their largest coordinate says how they were rounded
    void set(std::span<const uint32_t> corners, std::span<const Vec3d> points);

    // Twice the area, where the largest coordinate counted from the first corner is 1. At most 8;
    // 0 without area.
    double area() const { return area_; }
    // The largest coordinate counted from the first corner.
    double extent() const { return extent_; }
    // Corners at which the polygon turns the other way by more than a degree.
    size_t num_notches() const;

    // Appends the triangles. Returns false if the polygon has no area, crosses itself, or has so
    // many notches that the steps run out. What is left of it is then cut as a fan.
    bool cut(std::vector<Triangle>& triangles);

  private:
    bool cut_quad();
    bool cut_large();
    bool project();
    bool clip_ears(double tolerance);
    bool is_ear(uint32_t i, double tolerance);
    void place_strips(double tolerance);
    uint32_t strip_of(double coordinate) const;
    bool is_notch(uint32_t i, double tolerance) const;
    void set_notch(uint32_t i, bool is);
    void remove(uint32_t i);
    void emit(uint32_t a, uint32_t b, uint32_t c);
    void emit_fan();

    std::span<const uint32_t> corners_;
    std::vector<Vec3d> points_;  // counted from the first corner, in units of the extent
    Vec3d normal_ = Vec3d::Zero();
    double area_ = 0.0, extent_ = 0.0;
    double tolerance_ = 0.0;
    std::vector<Triangle>* triangles_ = nullptr;

    // The polygon that is left, a ring.
    std::vector<Eigen::Vector2d> flat_;
    std::vector<uint32_t> before_, after_;
    uint32_t first_ = 0, num_left_ = 0;
    std::vector<char> is_ear_;
    // Corners that are not convex, in any order, in strips across the polygon.
    std::vector<std::vector<uint32_t>> strips_;
    std::vector<uint32_t> notch_at_;  // of each corner: where in its strip, or kNone
    uint32_t num_strips_ = 0;
    int across_ = 0;  // the axis that the strips divide, from strip_begin_ on
    double strip_begin_ = 0.0, strips_per_unit_ = 0.0;
    uint64_t steps_left_ = 0;
};

}  // namespace paim
