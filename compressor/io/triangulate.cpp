// Triangulates polygons, once for all poses.
#include "compressor/io/triangulate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "paim/base/check.h"

namespace paim {

namespace {

using Corners = std::vector<uint32_t>;

// How much more area for its extent a polygon needs in another pose to be cut there.
constexpr double kFarMoreArea = 16.0;
// PolygonCutter::area() is 8 at most.
constexpr double kGreatestArea = 8.0;
// Against this share of the squared area, a triangle that faces the other way is rounding.
constexpr double kRounding = 1e-4;
constexpr double kNotchWeight = 16.0;

bool repeats_vertex(Corners corners) {
    std::sort(corners.begin(), corners.end());
    return std::adjacent_find(corners.begin(), corners.end()) != corners.end();
}

// Removes corners that are the same vertex as the one before.
void merge_neighbours(Corners& corners) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
}

// Removes triangles that name a vertex twice, from `first` on.
void drop_repeating(std::vector<Triangle>& triangles, size_t first) {
    const auto from = triangles.begin() + static_cast<std::ptrdiff_t>(first);
    triangles.erase(std::remove_if(from, triangles.end(),
                                   [](const Triangle& t) {
                                       return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
                                   }),
                    triangles.end());
}

// One polygon on its way to the cutter.
struct Shape {
    Corners corners;
    std::vector<Vec3d> points;
    bool repeats = false;

    // Takes the corners. Returns false if fewer than three different neighbours are left.
    bool take(std::span<const uint32_t> from) {
        corners.assign(from.begin(), from.end());
        repeats = repeats_vertex(corners);
        if (repeats) merge_neighbours(corners);
        return corners.size() >= 3;
    }
};

double score_of(const PolygonCutter& cutter) {
    return cutter.area() * (1.0 + kNotchWeight * static_cast<double>(cutter.num_notches())) *
           std::sqrt(cutter.extent());
}

Vec3d area_vector(const Triangle& t, std::span<const Vec3d> positions) {
    const Vec3d& a = positions[t[0]];
    return (positions[t[1]] - a).cross(positions[t[2]] - a);
}

}  // namespace

Triangulator::Triangulator(const Polygons& polygons, std::span<const Vec3f> positions)
    : polygons_(polygons) {
    std::vector<Triangle>& triangles = result_.triangles;
    PolygonCutter cutter;
    Shape shape;
    size_t first_corner = 0;
    for (uint32_t polygon = 0; polygon < polygons.num_faces(); ++polygon) {
        const uint32_t size = polygons.sizes[polygon];
        const auto from = std::span(polygons.corners).subspan(first_corner, size);
        for (const uint32_t v : from) PAIM_CHECK_LT(v, positions.size());
        const bool is_polygon = shape.take(from);
        if (shape.repeats) ++result_.num_repeating;
        if (is_polygon) {
            const size_t first_triangle = triangles.size();
            shape.points.clear();
            for (const uint32_t v : shape.corners) {
                shape.points.push_back(positions[v].cast<double>());
            }
            cutter.set(shape.corners, shape.points);
            const bool whole = cutter.cut(triangles);
            if (!whole) ++result_.num_degenerate;
            if (shape.repeats) drop_repeating(triangles, first_triangle);
            number_triangles(polygon);
            if (shape.corners.size() > 3) {
                cuts_.push_back({polygon, static_cast<uint32_t>(first_corner), size,
                                 static_cast<uint32_t>(first_triangle),
                                 static_cast<uint32_t>(triangles.size() - first_triangle),
                                 whole ? static_cast<float>(cutter.area()) : 0.0f,
                                 whole ? static_cast<float>(score_of(cutter)) : 0.0f, !whole});
            }
        }
        first_corner += size;
    }
}

// Gives the triangles that have no number this one.
void Triangulator::number_triangles(uint32_t polygon) {
    result_.polygons.resize(result_.triangles.size(), polygon);
}

// The area of the polygon for its extent, as PolygonCutter::area().
double Triangulator::relative_area(const Cut& cut, std::span<const Vec3d> positions) const {
    const auto corners = std::span(polygons_.corners).subspan(cut.first_corner, cut.num_corners);
    double extent = 0.0;
    for (const uint32_t v : corners) {
        const Vec3d difference = positions[v] - positions[corners[0]];
        extent = std::max(extent, difference.cwiseAbs().maxCoeff());
    }
    if (!(extent > 0.0)) return 0.0;
    Vec3d sum = Vec3d::Zero();
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
        const Vec3d& a = positions[corners[0]];
        sum +=
            ((positions[corners[i]] - a) / extent).cross((positions[corners[i + 1]] - a) / extent);
    }
    return sum.norm();
}

// Whether the triangles face as their polygon does. Their area vectors sum to that of the polygon.
bool Triangulator::is_right(const Cut& cut, std::span<const Vec3d> positions) const {
    const auto triangles =
        std::span(result_.triangles).subspan(cut.first_triangle, cut.num_triangles);
    if (triangles.size() == 2) {  // of a quad, without computing anything twice
        const Vec3d a = area_vector(triangles[0], positions);
        const Vec3d b = area_vector(triangles[1], positions);
        const Vec3d both = a + b;
        return std::min(a.dot(both), 0.0) + std::min(b.dot(both), 0.0) >=
               -kRounding * both.squaredNorm();
    }
    Vec3d sum = Vec3d::Zero();
    for (const Triangle& t : triangles) sum += area_vector(t, positions);
    double wrong = 0.0;
    for (const Triangle& t : triangles) {
        wrong += std::min(area_vector(t, positions).dot(sum), 0.0);
    }
    return wrong >= -kRounding * sum.squaredNorm();
}

void Triangulator::review(uint32_t pose, std::span<const Vec3d> positions, const Vec3d& origin) {
    for (size_t i = 0; i < cuts_.size(); ++i) {
        const Cut& cut = cuts_[i];
        const bool may_be_larger = kFarMoreArea * double{cut.area} < kGreatestArea;
        if (is_right(cut, positions) &&
            !(may_be_larger && relative_area(cut, positions) > kFarMoreArea * double{cut.area})) {
            continue;
        }
        try_pose(i, pose, positions, origin);
    }
}

void Triangulator::try_pose(size_t index, uint32_t pose, std::span<const Vec3d> positions,
                            const Vec3d& origin) {
    const Cut& cut = cuts_[index];
    Shape shape;
    shape.take(std::span(polygons_.corners).subspan(cut.first_corner, cut.num_corners));
    for (const uint32_t v : shape.corners) shape.points.push_back(positions[v] - origin);
    PolygonCutter cutter;
    cutter.set(shape.corners, shape.points);
    BetterCut better{score_of(cutter), pose, {}};
    const auto wins = [&](const auto& known) {
        if (known == better_.end()) return better.score > double{cut.score};
        return std::pair(-better.score, pose) < std::pair(-known->second.score, known->second.pose);
    };
    {
        const std::lock_guard lock(mutex_);
        if (!wins(better_.find(index))) return;
    }
    if (!cutter.cut(better.triangles)) return;
    if (shape.repeats) drop_repeating(better.triangles, 0);
    const std::lock_guard lock(mutex_);
    if (wins(better_.find(index))) better_[index] = std::move(better);
}

Triangulation Triangulator::finish() {
    if (better_.empty()) return std::move(result_);
    const std::vector<Triangle> old = std::move(result_.triangles);
    const std::vector<uint32_t> old_polygons = std::move(result_.polygons);
    std::vector<Triangle>& triangles = result_.triangles;
    std::vector<uint32_t>& polygons = result_.polygons;
    triangles.clear();
    polygons.clear();
    size_t copied = 0;
    // Those of the first pose.
    const auto copy = [&](size_t end) {
        const auto first = static_cast<std::ptrdiff_t>(copied);
        const auto last = static_cast<std::ptrdiff_t>(end);
        triangles.insert(triangles.end(), old.begin() + first, old.begin() + last);
        polygons.insert(polygons.end(), old_polygons.begin() + first, old_polygons.begin() + last);
    };
    for (const auto& [index, better] : better_) {
        const Cut& cut = cuts_[index];
        copy(cut.first_triangle);
        triangles.insert(triangles.end(), better.triangles.begin(), better.triangles.end());
        number_triangles(cut.polygon);
        copied = cut.first_triangle + cut.num_triangles;
        if (cut.degenerate) --result_.num_degenerate;
    }
    copy(old.size());
    return std::move(result_);
}

Triangulation triangulate(const Polygons& polygons, std::span<const Vec3f> positions) {
    return Triangulator(polygons, positions).finish();
}

}  // namespace paim
