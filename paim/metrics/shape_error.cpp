// How much decoding changes the shape of a surface where one looks.
// Based on: Vasa and Skala 2011 (see the header)
#include "paim/metrics/shape_error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"
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

ShapeErrorMeter::ShapeErrorMeter(const Topology& topology)
    : topology_(topology),
      pieces_(connected_pieces(topology)),
      face_vertices_(face_vertices(topology)),
      edges_(edges_of(topology)),
      sums_(pieces_.count) {}

void ShapeErrorMeter::add(std::span<const float> positions, std::span<const float> reference) {
    PAIM_CHECK_EQ(positions.size(), size_t{3} * topology_.num_vertices);
    PAIM_CHECK_EQ(reference.size(), positions.size());
    add_edges(positions, reference);
    add_normals(positions, reference);
    if (!reference_.empty()) add_steps(positions, reference);
    positions_.assign(positions.begin(), positions.end());
    reference_.assign(reference.begin(), reference.end());
}

void ShapeErrorMeter::add_edges(std::span<const float> positions,
                                std::span<const float> reference) {
    std::vector<Neighbourhood> around(topology_.num_vertices);
    for (const auto& [a, b] : edges_) {
        const double length = (point(reference, a) - point(reference, b)).norm();
        if (!(length > 0.0)) continue;
        const double decoded = (point(positions, a) - point(positions, b)).norm();
        const double difference = std::abs(decoded - length) / length;
        around[a].add(length, difference);
        around[b].add(length, difference);
    }
    for (size_t v = 0; v < around.size(); ++v) {
        if (!(around[v].weight > 0.0)) continue;
        Sums& sums = sums_[pieces_.of_vertex[v]];
        sums.space += around[v].deviation();
        ++sums.num_space;
    }
}

void ShapeErrorMeter::add_steps(std::span<const float> positions,
                                std::span<const float> reference) {
    const Bounds bounds = bounds_of_vertices(reference, face_vertices_);
    const double time =
        bounds.empty()
            ? 0.0
            : 0.01 * (bounds.upper.cast<double>() - bounds.lower.cast<double>()).stableNorm();
    std::vector<Step> steps(topology_.num_vertices);
    for (size_t v = 0; v < steps.size(); ++v) {
        if (pieces_.num_vertices[pieces_.of_vertex[v]] == 1) continue;  // no face has it
        const double length = std::hypot((point(reference, v) - point(reference_, v)).norm(), time);
        const double decoded =
            std::hypot((point(positions, v) - point(positions_, v)).norm(), time);
        if (!(length > 0.0)) continue;
        steps[v] = {static_cast<float>(length),
                    static_cast<float>(std::abs(decoded - length) / length)};
        if (steps_.empty()) continue;
        Neighbourhood around;
        around.add(double{steps_[v].length}, double{steps_[v].difference});
        around.add(double{steps[v].length}, double{steps[v].difference});
        if (!(around.weight > 0.0)) continue;
        Sums& sums = sums_[pieces_.of_vertex[v]];
        sums.time += around.deviation();
        ++sums.num_time;
    }
    steps_ = std::move(steps);
}

void ShapeErrorMeter::add_normals(std::span<const float> positions,
                                  std::span<const float> reference) {
    const auto normal = [](std::span<const float> planes, const Triangle& t) {
        const Vec3d a = point(planes, t[0]);
        return Vec3d((point(planes, t[1]) - a).cross(point(planes, t[2]) - a));
    };
    for (const Triangle& t : topology_.triangles) {
        const Vec3d baked = normal(reference, t);
        const Vec3d decoded = normal(positions, t);
        if (baked.isZero(0.0)) continue;
        Sums& sums = sums_[pieces_.of_vertex[t[0]]];
        // A face that has lost its area has turned by as much as a face can without a direction.
        sums.angle +=
            decoded.isZero(0.0)
                ? 90.0
                : std::atan2(baked.cross(decoded).norm(), baked.dot(decoded)) * 180.0 / kPi;
        ++sums.num_angles;
    }
}

PieceShapeError ShapeErrorMeter::result() const {
    PieceShapeError error;
    Sums all;
    for (size_t j = 0; j < sums_.size(); ++j) {
        all.add(sums_[j]);
        const uint32_t size = pieces_.num_vertices[j];
        if (size < kSmallestPiece && 20 * uint64_t{size} < topology_.num_vertices) continue;
        const ShapeError piece = sums_[j].mean();
        if (piece.sted() > error.worst.sted()) {
            error.worst.sted_space = piece.sted_space;
            error.worst.sted_time = piece.sted_time;
        }
        error.worst.normal_angle_deg =
            std::max(error.worst.normal_angle_deg, piece.normal_angle_deg);
    }
    error.whole = all.mean();
    if (error.whole.sted() > error.worst.sted()) {
        error.worst.sted_space = error.whole.sted_space;
        error.worst.sted_time = error.whole.sted_time;
    }
    error.worst.normal_angle_deg =
        std::max(error.worst.normal_angle_deg, error.whole.normal_angle_deg);
    return error;
}

uint64_t ShapeErrorMeter::bytes(uint64_t num_vertices, uint64_t num_triangles) {
    return num_vertices * (2 * 3 * sizeof(float) + 2 * sizeof(Step) + sizeof(Neighbourhood) +
                           3 * sizeof(uint32_t)) +
           3 * num_triangles * sizeof(std::array<uint32_t, 2>);
}

}  // namespace paim
