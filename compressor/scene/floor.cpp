// Poses of another source with a floor under them.
#include "compressor/scene/floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/hash.h"
#include "paim/base/median.h"
#include "paim/base/parallel.h"
#include "paim/mesh/body_size.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/outliers.h"
#include "paim/mesh/planes.h"

namespace paim {

namespace {

// Below the lowest point, relative to the size of the body: far more than rounding and ray offsets.
constexpr double kGap = 5e-4;
// The size of the body is the largest extent of all poses, but at most this many times that of a
// pose: it moves without travelling, and then all poses make the gap.
constexpr double kInPlace = 2.0;
// Relative to the largest extent of all poses.
constexpr double kFine = 0.08;    // distance of fine cells beyond the bounds of the poses
constexpr double kEdge = 0.3;     // distance of the floor's edge beyond them
constexpr double kGrowth = 1.25;  // ratio of a cell to its inner neighbour, beyond the fine cells

// Lines of the grid along one axis: fine cells of the size `cell` from lower to upper (scaled to
// fit a whole number), then growing ones up to the distance `reach` on both sides.
std::vector<double> grid_lines(double lower, double upper, double cell, double reach) {
    const auto num_fine = static_cast<size_t>(std::max(1.0, std::ceil((upper - lower) / cell)));
    const double width = (upper - lower) / static_cast<double>(num_fine);
    std::vector<double> outside;  // distances from the fine part, the last exactly `reach`
    double step = kGrowth * std::max(width, cell);
    for (double at = step; at < reach; at += step) {
        outside.push_back(at);
        step *= kGrowth;
    }
    outside.push_back(reach);
    // A very narrow last cell is joined with the one before it.
    if (outside.size() > 1 && reach - outside[outside.size() - 2] < 0.5 * step / kGrowth) {
        outside.erase(outside.end() - 2);
    }
    std::vector<double> lines;
    for (size_t i = outside.size(); i-- > 0;) lines.push_back(lower - outside[i]);
    for (size_t i = 0; i <= num_fine; ++i) {
        lines.push_back(lower + width * static_cast<double>(i));
    }
    for (const double distance : outside) lines.push_back(upper + distance);
    return lines;
}

struct Grid {
    std::vector<double> x, z;
    size_t num_vertices() const { return x.size() * z.size(); }
};

}  // namespace

Floor::Floor(const BodyBounds& bounds, uint32_t max_vertices) {
    PAIM_CHECK(!bounds.all.empty());
    PAIM_CHECK_LE(kMinFloorVertices, max_vertices);
    const Vec3d lower = bounds.all.lower.cast<double>(), upper = bounds.all.upper.cast<double>();
    const double extent = (upper - lower).maxCoeff();
    if (!(extent > 0.0)) throw_bad_input("floor: the poses are one point, there is no size for it");
    const double fine = kFine * extent, reach = (kEdge - kFine) * extent;
    const auto grid_of = [&](double cell) {
        return Grid{grid_lines(lower.x() - fine, upper.x() + fine, cell, reach),
                    grid_lines(lower.z() - fine, upper.z() + fine, cell, reach)};
    };
    // Finds, to a thousandth, the finest cells within the number of vertices. The coarsest grid,
    // with cells as large as the floor, has 4 × 4 vertices.
    double too_fine = 0.0, cell = (1.0 + 2.0 * kEdge) * extent;
    while (cell - too_fine > 1e-3 * cell) {
        const double middle = 0.5 * (too_fine + cell);
        // The first comparison bounds the number of lines before they are made.
        const bool fits =
            extent / middle <= max_vertices && grid_of(middle).num_vertices() <= max_vertices;
        (fits ? cell : too_fine) = middle;
    }
    const Grid grid = grid_of(cell);

    // Rounding must move neither the floor up to the lowest point, nor the starts of rays, which are
    // four roundings of the largest coordinate above the floor and below the body.
    constexpr double kRoundings = 16.0;
    const double size = std::min(extent, kInPlace * bounds.body_extent);
    const double largest = std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
    const double gap =
        std::max(kGap * size,
                 kRoundings * largest * static_cast<double>(std::numeric_limits<float>::epsilon()));
    height = static_cast<float>(lower.y() - gap);
    for (const double z : grid.z) {
        for (const double x : grid.x) {
            positions.push_back({static_cast<float>(x), height, static_cast<float>(z)});
            if (!positions.back().allFinite()) {
                throw_bad_input("floor: the poses are too large for one ({} across)", extent);
            }
        }
    }
    topology.num_vertices = static_cast<uint32_t>(positions.size());
    const auto num_x = static_cast<uint32_t>(grid.x.size());
    for (uint32_t j = 0; j + 1 < grid.z.size(); ++j) {
        for (uint32_t i = 0; i + 1 < num_x; ++i) {
            const uint32_t a = j * num_x + i, b = a + 1, c = a + num_x, d = c + 1;
            // Diagonals alternate, so that no direction is preferred.
            if ((i + j) % 2 == 0) {
                topology.triangles.push_back({a, c, d});
                topology.triangles.push_back({a, d, b});
            } else {
                topology.triangles.push_back({a, c, b});
                topology.triangles.push_back({b, c, d});
            }
        }
    }
}

namespace {

// Where most vertices of a pose are, in local coordinates.
struct Middle {
    Vec3d centre = Vec3d::Zero();
    double size = 0.0;      // about the diagonal
    double farthest = 0.0;  // distance of a vertex from the centre
};

// The sphere in which most vertices of all poses are, in local coordinates. What is farther off may be
// an outlier.
struct UsualPlace {
    Vec3d centre = Vec3d::Zero();
    double radius = 0.0;
};

BodyBounds over_all(std::span<const Bounds> of_poses) {
    BodyBounds result;
    std::vector<double> extents;
    for (const Bounds& bounds : of_poses) {
        result.all.extend(bounds);
        if (bounds.empty()) continue;
        extents.push_back((bounds.upper.cast<double>() - bounds.lower.cast<double>()).maxCoeff());
    }
    if (!extents.empty()) result.body_extent = median(std::move(extents));
    return result;
}

class PoseBounds {
  public:
    PoseBounds(const PoseSource& source, const RootMotion& root_motion)
        : source_(source), root_motion_(root_motion), vertices_(face_vertices(source.topology())) {}

    BodyBounds find(const std::function<void()>& on_pose) const {
        std::vector<Middle> middles(source_.num_poses());
        std::vector<Bounds> bounds(middles.size());
        parallel_for(middles.size(), 1, [&](size_t p, size_t) {
            const std::vector<Vec3f> points = points_of(load(p), vertices_);
            bounds[p].extend(points);
            middles[p] = middle_of(p, points);
            if (on_pose) on_pose();
        });
        if (vertices_.empty()) return over_all(bounds);
        const UsualPlace usual = usual_place(middles);
        const std::vector<uint32_t> far = far_from(usual, middles);
        // So many are no outliers, but much of the mesh.
        constexpr uint64_t kMostBytes = uint64_t{256} << 20;
        if (far.empty() || uint64_t{far.size()} * middles.size() * sizeof(Vec3f) > kMostBytes) {
            return over_all(bounds);
        }
        // Some others say how large the mesh is.
        constexpr size_t kMostOthers = 1000;
        const size_t step = vertices_.size() / kMostOthers + 1;
        std::vector<uint32_t> some, tracked, near;
        for (size_t k = 0; k < vertices_.size(); k += step) some.push_back(vertices_[k]);
        std::set_union(far.begin(), far.end(), some.begin(), some.end(),
                       std::back_inserter(tracked));
        std::set_difference(vertices_.begin(), vertices_.end(), tracked.begin(), tracked.end(),
                            std::back_inserter(near));
        return without_outliers(near, tracked);
    }

  private:
    std::vector<Vec3f> load(size_t p) const {
        return load_positions_from_origin(source_, static_cast<uint32_t>(p));
    }
    static std::vector<Vec3f> points_of(std::span<const Vec3f> positions,
                                        std::span<const uint32_t> vertices) {
        std::vector<Vec3f> points;
        for (const uint32_t v : vertices) points.push_back(positions[v]);
        return points;
    }
    Vec3d to_local(size_t p, const Vec3f& point) const {
        return root_at(root_motion_, static_cast<double>(p)).to_local(point.cast<double>());
    }

    Middle middle_of(size_t p, std::span<const Vec3f> points) const {
        Middle middle;
        if (points.empty()) return middle;
        std::vector<Vec3d> local;
        for (const Vec3f& point : points) local.push_back(to_local(p, point));
        middle.centre = median_point(local);
        middle.size = size_of(local);
        for (const Vec3d& point : local) {
            middle.farthest = std::max(middle.farthest, (point - middle.centre).stableNorm());
        }
        return middle;
    }

    static UsualPlace usual_place(std::span<const Middle> middles) {
        constexpr double kSizes = 4.0;
        std::vector<Vec3d> centres;
        UsualPlace usual;
        for (const Middle& middle : middles) {
            centres.push_back(middle.centre);
            usual.radius = std::max(usual.radius, kSizes * middle.size);
        }
        usual.centre = median_point(centres);
        return usual;
    }

    // Ascending. Reads poses again if one of them reaches beyond that place.
    std::vector<uint32_t> far_from(const UsualPlace& usual, std::span<const Middle> middles) const {
        std::vector<bool> is_far(source_.topology().num_vertices, false);
        for (size_t p = 0; p < middles.size(); ++p) {
            const double reach =
                (middles[p].centre - usual.centre).stableNorm() + middles[p].farthest;
            if (reach <= usual.radius) continue;
            const std::vector<Vec3f> points = points_of(load(p), vertices_);
            for (size_t j = 0; j < points.size(); ++j) {
                if ((to_local(p, points[j]) - usual.centre).stableNorm() > usual.radius) {
                    is_far[vertices_[j]] = true;
                }
            }
        }
        std::vector<uint32_t> far;
        for (const uint32_t v : vertices_) {
            if (is_far[v]) far.push_back(v);
        }
        return far;
    }

    // Bounds of both. Outliers are looked for among the tracked vertices.
    BodyBounds without_outliers(std::span<const uint32_t> near,
                                std::span<const uint32_t> tracked) const {
        const auto count = static_cast<uint32_t>(tracked.size());
        std::vector<std::vector<float>> planes(source_.num_poses());  // [P][3][tracked], local
        std::vector<Bounds> bounds(planes.size());
        parallel_for(planes.size(), 1, [&](size_t p, size_t) {
            const std::vector<Vec3f> positions = load(p);
            bounds[p].extend(points_of(positions, near));
            std::vector<Vec3f> points = points_of(positions, tracked);
            for (Vec3f& point : points) point = to_local(p, point).cast<float>();
            planes[p] = to_planes(points);
        });
        std::vector<uint32_t> all(count);
        std::iota(all.begin(), all.end(), 0u);
        const PositionOutliers outliers = find_outliers(
            count, source_.num_poses(), all,
            [&](uint32_t p, uint64_t first, uint64_t num_rows, float* rows) {
                std::copy_n(planes[p].begin() + static_cast<ptrdiff_t>(first), num_rows, rows);
            });
        for (uint32_t p = 0; p < source_.num_poses(); ++p) {
            outliers.replace(p, count, 0, planes[p]);
            move_to_scene(root_at(root_motion_, p), planes[p]);
            bounds[p].extend(bounds_of_vertices(planes[p], all));
        }
        return over_all(bounds);
    }

    const PoseSource& source_;
    const RootMotion& root_motion_;
    const std::vector<uint32_t> vertices_;
};

}  // namespace

BodyBounds bounds_of(const PoseSource& source, const std::function<void()>& on_pose,
                     const RootMotion& root_motion) {
    return PoseBounds(source, root_motion).find(on_pose);
}

PosesOnFloor::PosesOnFloor(const PoseSource& source, const BodyBounds& bounds,
                           const FloorOptions& options)
    : source_(source),
      floor_(bounds, options.num_vertices),
      topology_(source.topology()),
      albedo_(source.albedo()),
      materials_(source.materials()),
      texture_(source.texture()),
      positions_xxh3_(xxh3(floor_.positions.data(), floor_.positions.size() * sizeof(Vec3f))),
      description_(fmt::format("{} vertices at y = {}, albedo {},{},{}",
                               floor_.topology.num_vertices, floor_.height, options.albedo.x(),
                               options.albedo.y(), options.albedo.z())) {
    const uint32_t first = topology_.num_vertices;
    const uint32_t num_floor = floor_.topology.num_vertices;
    if (first > std::numeric_limits<int32_t>::max() - num_floor) {
        throw_bad_input("floor: {} vertices are too many to add {}", first, num_floor);
    }
    texture_.append({}, topology_.triangles.size(), floor_.topology.triangles.size());
    topology_.append(floor_.topology);
    albedo_.append({{options.albedo}}, first, num_floor);
    materials_.append({}, first, num_floor);
}

uint64_t PosesOnFloor::pose_checksum(uint32_t p) const {
    const uint64_t parts[2] = {source_.pose_checksum(p), positions_xxh3_};
    return xxh3(parts, sizeof parts);
}

Pose PosesOnFloor::load_pose(uint32_t p) const {
    Pose pose = load_from_origin(source_, p);
    pose.positions.insert(pose.positions.end(), floor_.positions.begin(), floor_.positions.end());
    pose.normals.resize(pose.positions.size(), Vec3f::UnitY());
    return pose;
}

}  // namespace paim
