// Triangulates polygons, once for all poses.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <vector>

#include "compressor/io/polygon_cutter.h"
#include "compressor/io/polygons.h"
#include "paim/mesh/topology.h"

namespace paim {

struct Triangulation {
    std::vector<Triangle> triangles;  // in the order of the polygons, with their winding
    std::vector<uint32_t> polygons;   // [triangles] the number of the polygon that each is of
    // Polygons that name a vertex twice. Corners that repeat their neighbour are merged first;
    // triangles that still name one twice are dropped.
    uint64_t num_repeating = 0;
    // Polygons that have no area or cross themselves in every pose that was looked at. They are
    // split like a fan if ear clipping fails.
    uint64_t num_degenerate = 0;
};

// Cuts each polygon by its shape in one pose (polygon_cutter.h). That is the first pose, unless its
// cut is wrong in another pose: a triangle faces against its polygon there, or the polygon has far
// more area there for its extent. Then the pose with the greatest score decides for this polygon.
// The score is the area for the extent, times 1 plus 16 for each notch, times the root of the
// extent. A cut that respects the notches of one pose is right where they are filled, and not the
// other way round. Small shapes have fewer digits in their files. Poses in which the polygon has no
// area, or crosses itself, do not count.
class Triangulator {
  public:
    // Cuts by the first pose.
    // polygons   must outlive this
    // positions  [V] scene units, finite
    Triangulator(const Polygons& polygons, std::span<const Vec3f> positions);

    // Looks at another pose. May be called by several threads, in any order. Takes no notable time
    // if the cut is right there.
    // pose       its number, above 0
    // positions  [V] scene units, finite
    // origin     near them
    void review(uint32_t pose, std::span<const Vec3d> positions, const Vec3d& origin);

    Triangulation finish();

  private:
    // A polygon that was cut, which is none of three corners. Small, because there are as many as
    // quads. Files are too small for more than 2^32 corners.
    struct Cut {
        uint32_t polygon, first_corner, num_corners;
        uint32_t first_triangle, num_triangles;
        float area, score;  // in the first pose; 0 if degenerate
        bool degenerate;    // in the first pose
    };
    struct BetterCut {
        double score;
        uint32_t pose;
        std::vector<Triangle> triangles;
    };

    void number_triangles(uint32_t polygon);
    double relative_area(const Cut& cut, std::span<const Vec3d> positions) const;
    bool is_right(const Cut& cut, std::span<const Vec3d> positions) const;
    void try_pose(size_t cut, uint32_t pose, std::span<const Vec3d> positions, const Vec3d& origin);

    const Polygons& polygons_;
    Triangulation result_;
    std::vector<Cut> cuts_;
    std::mutex mutex_;  // guards better_
    std::map<size_t, BetterCut> better_;
};

// By the shape in one pose alone.
Triangulation triangulate(const Polygons& polygons, std::span<const Vec3f> positions);

}  // namespace paim
