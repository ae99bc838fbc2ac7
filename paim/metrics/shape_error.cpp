// How much decoding changes the shape of a surface where one looks.
// Based on: Vasa and Skala 2011 (see the header)
#include "paim/metrics/shape_error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/base/vector.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

Vec3d point(std::span<const float> planes, size_t v) {
    const size_t count = planes.size() / 3;
    return {double{planes[v]}, double{planes[count + v]}, double{planes[2 * count + v]}};
}

// Sums over the edges of a vertex.
struct Neighbourhood {
    double weight = 0.0, sum = 0.0, squares = 0.0;

    void add(double length, double difference) {
        weight += length;
        sum += length * difference;
        squares += length * difference * difference;
    }
    double deviation() const {
        const double mean = sum / weight;
        return std::sqrt(std::max(0.0, squares / weight - mean * mean));
    }
};

std::vector<std::array<uint32_t, 2>> edges_of(const Topology& topology) {
    std::vector<std::array<uint32_t, 2>> edges;
    edges.reserve(3 * topology.triangles.size());
    for (const Triangle& t : topology.triangles) {
        for (size_t j = 0; j < 3; ++j) {
            const auto [low, high] = std::minmax(t[j], t[(j + 1) % 3]);
            if (low != high) edges.push_back({low, high});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

double mean_of(double sum, uint64_t count) {
    return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

double ShapeError::sted() const {
    return std::hypot(sted_space, sted_time);
}

void ShapeErrorMeter::Sums::add(const Sums& other) {
    space += other.space;
    time += other.time;
    angle += other.angle;
    num_space += other.num_space;
    num_time += other.num_time;
    num_angles += other.num_angles;
}

ShapeError ShapeErrorMeter::Sums::mean() const {
    return {mean_of(space, num_space), mean_of(time, num_time), mean_of(angle, num_angles)};
}

ShapeNeighbours::ShapeNeighbours(const Topology& topology,
                                 std::span<const std::vector<float>> poses)
    : num_vertices(topology.num_vertices),
      triangles(topology.triangles),
      edges(edges_of(topology)),
      face_vertices(paim::face_vertices(topology)),
      judged(
          judged_pieces(topology, face_vertices, mean_edge_lengths(num_vertices, edges, poses))) {}

uint64_t ShapeNeighbours::bytes(uint64_t num_vertices, uint64_t num_triangles) {
    // Edges are found among all sides of the triangles.
    return num_triangles * (sizeof(Triangle) + 3 * sizeof(std::array<uint32_t, 2>)) +
           num_vertices * (4 * sizeof(uint32_t) + 3 * sizeof(double));
}

void ShapeErrorMeter::add(std::span<const Pose> poses) {
    for (const Pose& pose : poses) {
        PAIM_CHECK_EQ(pose.positions.size(), size_t{3} * mesh_.num_vertices);
        PAIM_CHECK_EQ(pose.reference.size(), pose.positions.size());
    }
    if (poses.empty()) return;
    std::vector<PieceSums> sums(poses.size(), PieceSums(sums_.size()));
    std::vector<std::vector<Step>> led_to(poses.size());  // empty: there is no pose before
    parallel_for(poses.size(), 1, [&](size_t p, size_t) {
        add_edges(poses[p], sums[p]);
        add_normals(poses[p], sums[p]);
        const Pose& before = p > 0 ? poses[p - 1] : last_;
        if (!before.reference.empty()) led_to[p] = steps(before, poses[p]);
    });
    parallel_for(poses.size(), 1, [&](size_t p, size_t) {
        const std::vector<Step>& before = p > 0 ? led_to[p - 1] : last_steps_;
        if (!before.empty()) add_steps(before, led_to[p], sums[p]);
    });
    for (const PieceSums& of_pose : sums) {
        for (size_t j = 0; j < sums_.size(); ++j) sums_[j].add(of_pose[j]);
    }
    last_ = poses.back();
    last_steps_ = std::move(led_to.back());
}

void ShapeErrorMeter::add_edges(const Pose& pose, PieceSums& sums) const {
    std::vector<Neighbourhood> around(mesh_.num_vertices);
    for (const auto& [a, b] : mesh_.edges) {
        const double length = (point(pose.reference, a) - point(pose.reference, b)).norm();
        if (!(length > 0.0)) continue;
        const double decoded = (point(pose.positions, a) - point(pose.positions, b)).norm();
        const double difference = std::abs(decoded - length) / length;
        around[a].add(length, difference);
        around[b].add(length, difference);
    }
    for (size_t v = 0; v < around.size(); ++v) {
        if (!(around[v].weight > 0.0)) continue;
        Sums& sum = sums_of(static_cast<uint32_t>(v), sums);
        sum.space += around[v].deviation();
        ++sum.num_space;
    }
}

std::vector<ShapeErrorMeter::Step> ShapeErrorMeter::steps(const Pose& before,
                                                          const Pose& pose) const {
    const Bounds bounds = bounds_of_vertices(pose.reference, mesh_.face_vertices);
    const double time =
        bounds.empty()
            ? 0.0
            : 0.01 * (bounds.upper.cast<double>() - bounds.lower.cast<double>()).stableNorm();
    std::vector<Step> steps(mesh_.num_vertices);
    for (const uint32_t v : mesh_.face_vertices) {
        const double length =
            std::hypot((point(pose.reference, v) - point(before.reference, v)).norm(), time);
        const double decoded =
            std::hypot((point(pose.positions, v) - point(before.positions, v)).norm(), time);
        if (!(length > 0.0)) continue;
        steps[v] = {static_cast<float>(length),
                    static_cast<float>(std::abs(decoded - length) / length)};
    }
    return steps;
}

void ShapeErrorMeter::add_steps(const std::vector<Step>& before, const std::vector<Step>& steps,
                                PieceSums& sums) const {
    for (const uint32_t v : mesh_.face_vertices) {
        if (!(steps[v].length > 0.0f)) continue;
        Neighbourhood around;
        around.add(double{before[v].length}, double{before[v].difference});
        around.add(double{steps[v].length}, double{steps[v].difference});
        Sums& sum = sums_of(static_cast<uint32_t>(v), sums);
        sum.time += around.deviation();
        ++sum.num_time;
    }
}

void ShapeErrorMeter::add_normals(const Pose& pose, PieceSums& sums) const {
    const auto normal = [](std::span<const float> planes, const Triangle& t) {
        const Vec3d a = point(planes, t[0]);
        return Vec3d((point(planes, t[1]) - a).cross(point(planes, t[2]) - a));
    };
    for (const Triangle& t : mesh_.triangles) {
        const Vec3d baked = normal(pose.reference, t);
        const Vec3d decoded = normal(pose.positions, t);
        if (baked.isZero(0.0)) continue;
        Sums& sum = sums_of(std::min({t[0], t[1], t[2]}), sums);
        // A face between two pieces counts for the same one however its corners are rotated, which files
        // do. A face that has lost its area has turned by as much as a face can without a direction.
        sum.angle +=
            decoded.isZero(0.0)
                ? 90.0
                : std::atan2(baked.cross(decoded).norm(), baked.dot(decoded)) * 180.0 / kPi;
        ++sum.num_angles;
    }
}

PieceShapeError ShapeErrorMeter::result() const {
    Sums all;
    for (const Sums& sums : sums_) all.add(sums);
    PieceShapeError error;
    error.whole = all.mean();
    error.worst = error.whole;
    for (size_t j = 0; j < mesh_.judged.count; ++j) {
        const ShapeError piece = sums_[j].mean();
        if (piece.sted() > error.worst.sted()) {
            error.worst.sted_space = piece.sted_space;
            error.worst.sted_time = piece.sted_time;
        }
        error.worst.normal_angle_deg =
            std::max(error.worst.normal_angle_deg, piece.normal_angle_deg);
    }
    return error;
}

uint64_t ShapeErrorMeter::bytes(uint64_t num_vertices, uint64_t num_poses_at_once) {
    return num_vertices * (2 * 3 * sizeof(float) + sizeof(Step) +
                           num_poses_at_once * (sizeof(Step) + sizeof(Neighbourhood)));
}

}  // namespace paim
