// Poses of another source with a floor under them.
#include "compressor/scene/floor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>

#include "compressor/scene/rigid_fit.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/hash.h"
#include "paim/base/parallel.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/outliers.h"
#include "paim/mesh/planes.h"

namespace paim {

namespace {

// All relative to the largest extent of the poses.
constexpr double kGap = 5e-4;     // below the lowest point: far more than rounding and ray offsets
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

Floor::Floor(const Bounds& bounds, uint32_t max_vertices) {
    PAIM_CHECK(!bounds.empty());
    PAIM_CHECK_LE(kMinFloorVertices, max_vertices);
    const Vec3d lower = bounds.lower.cast<double>(), upper = bounds.upper.cast<double>();
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

    // Rounding must not move the floor up to the lowest point.
    const double largest = std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
    const double gap = std::max(
        kGap * extent, 16.0 * largest * static_cast<double>(std::numeric_limits<float>::epsilon()));
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

// Bounds of the vertices near most others, and numbers of vertices that are far from them in a pose.
struct NearAndFar {
    Bounds near;
    std::vector<uint32_t> far;
};

NearAndFar near_and_far(const Pose& pose, std::span<const uint32_t> vertices) {
    constexpr double kSizes = 4.0;
    NearAndFar result;
    std::vector<Vec3d> points;
    for (const uint32_t v : vertices) points.push_back(pose.positions[v].cast<double>());
    if (points.empty()) return result;
    const std::vector<Vec3d> at_origin(points.size(), Vec3d::Zero());
    const Vec3d centre = median_difference(at_origin, points);
    const double farthest = kSizes * size_of(points);
    for (size_t j = 0; j < vertices.size(); ++j) {
        if ((points[j] - centre).stableNorm() > farthest) {
            result.far.push_back(vertices[j]);
        } else {
            result.near.extend(pose.positions[vertices[j]]);
        }
    }
    return result;
}

// Bounds over all poses of vertices that are far from most others in some pose, without outliers.
Bounds bounds_of_far(const PoseSource& source, const std::vector<uint32_t>& far) {
    const auto count = static_cast<uint32_t>(far.size());
    std::vector<std::vector<float>> planes(source.num_poses());  // [P][3][far]
    parallel_for(planes.size(), 1, [&](size_t p, size_t) {
        const Pose pose = load_from_origin(source, static_cast<uint32_t>(p));
        std::vector<Vec3f> points;
        for (const uint32_t v : far) points.push_back(pose.positions[v]);
        planes[p] = to_planes(points);
    });
    std::vector<uint32_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    const PositionOutliers outliers = find_outliers(
        count, source.num_poses(), all,
        [&](uint32_t p, uint64_t first, uint64_t num_rows, float* rows) {
            std::copy_n(planes[p].begin() + static_cast<ptrdiff_t>(first), num_rows, rows);
        });
    Bounds bounds;
    for (uint32_t p = 0; p < source.num_poses(); ++p) {
        outliers.replace(p, count, 0, planes[p]);
        bounds.extend(bounds_of_vertices(planes[p], all));
    }
    return bounds;
}

}  // namespace

Bounds bounds_of(const PoseSource& source, const std::function<void()>& on_pose) {
    const std::vector<uint32_t> vertices = face_vertices(source.topology());
    Bounds all, near;
    std::vector<bool> is_far(source.topology().num_vertices, false);
    std::mutex mutex;
    parallel_for(source.num_poses(), 1, [&](size_t p, size_t) {
        const Pose pose = load_from_origin(source, static_cast<uint32_t>(p));
        Bounds bounds;
        for (const uint32_t v : vertices) bounds.extend(pose.positions[v]);
        const NearAndFar of_pose = near_and_far(pose, vertices);
        {
            const std::lock_guard lock(mutex);  // a minimum does not depend on the order
            all.extend(bounds);
            near.extend(of_pose.near);
            for (const uint32_t v : of_pose.far) is_far[v] = true;
        }
        if (on_pose) on_pose();
    });
    std::vector<uint32_t> far;
    for (const uint32_t v : vertices) {
        if (is_far[v]) far.push_back(v);
    }
    if (far.empty()) return all;
    // So many are no outliers, but much of the mesh.
    constexpr uint64_t kMostBytes = uint64_t{256} << 20;
    if (uint64_t{far.size()} * source.num_poses() * sizeof(Vec3f) > kMostBytes) return all;
    near.extend(bounds_of_far(source, far));
    return near;
}

PosesOnFloor::PosesOnFloor(const PoseSource& source, const Bounds& bounds,
                           const FloorOptions& options)
    : source_(source),
      floor_(bounds, options.num_vertices),
      topology_(source.topology()),
      albedo_(source.albedo()),
      positions_xxh3_(xxh3(floor_.positions.data(), floor_.positions.size() * sizeof(Vec3f))),
      description_(fmt::format("{} vertices at y = {}, albedo {},{},{}",
                               floor_.topology.num_vertices, floor_.height, options.albedo.x(),
                               options.albedo.y(), options.albedo.z())) {
    const uint32_t first = topology_.num_vertices;
    const uint32_t num_floor = floor_.topology.num_vertices;
    if (first > std::numeric_limits<int32_t>::max() - num_floor) {
        throw_bad_input("floor: {} vertices are too many to add {}", first, num_floor);
    }
    topology_.append(floor_.topology);
    albedo_.append({{options.albedo}}, first, num_floor);
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
