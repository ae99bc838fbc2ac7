// Frames of vertices that move with the surface around them.
#include "paim/mesh/tangent_frames.h"

#include <Eigen/LU>

#include <cmath>

#include "paim/base/check.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/normals.h"

namespace paim {

namespace {

// The direction that x axes of the reference pose follow: none that the flat sides of models face, where
// noise of positions alone would turn its projection. Its length is 1.
const Vec3d kGuide(0.8, 0.36, 0.48);
// Shorter projections of unit vectors say nothing about a direction.
constexpr double kShortest = 1e-4;

Vec3d edge(std::span<const Vec3f> positions, const Triangle& t, size_t corner, size_t e) {
    return positions[t[(corner + 1 + e) % 3]].cast<double>() - positions[t[corner]].cast<double>();
}

Vec3d unit_in_plane(const Vec3d& direction, const Vec3d& normal) {
    const Vec3d projected = direction - direction.dot(normal) * normal;
    return projected.norm() > kShortest ? Vec3d(projected.normalized()) : Vec3d(Vec3d::Zero());
}

// A tangent of zero: the guide's direction in the plane of the normal.
Eigen::Matrix3d frame_of(const Vec3d& tangent, const Vec3d& normal) {
    Vec3d x = tangent;
    if (x.isZero(0.0)) x = unit_in_plane(kGuide, normal);
    if (x.isZero(0.0)) x = unit_in_plane(Vec3d::UnitY(), normal);
    Eigen::Matrix3d frame;
    frame << x, normal.cross(x), normal;
    return frame;
}

// Frames of the reference pose. Zero where the normal is.
std::vector<Eigen::Matrix3d> reference_frames(std::span<const Vec3f> normals) {
    std::vector<Eigen::Matrix3d> frames;
    for (const Vec3f& n : normals) {
        const Vec3d normal = n.cast<double>();
        frames.push_back(normal.isZero(0.0) ? Eigen::Matrix3d(Eigen::Matrix3d::Zero())
                                            : frame_of(Vec3d::Zero(), normal));
    }
    return frames;
}

}  // namespace

TangentFrames::TangentFrames(const Topology& topology, std::span<const Vec3f> reference)
    : topology_(without_duplicate_faces(topology)), weights_(topology_.triangles.size()) {
    PAIM_CHECK_EQ(reference.size(), topology.num_vertices);
    const std::vector<Eigen::Matrix3d> frames =
        reference_frames(vertex_normals(topology_, reference));
    const auto for_each_edge = [&](const auto& use) {
        for (size_t f = 0; f < topology_.triangles.size(); ++f) {
            for (size_t corner = 0; corner < 3; ++corner) {
                for (size_t e = 0; e < 2; ++e) {
                    const uint32_t v = topology_.triangles[f][corner];
                    const Vec3d along = edge(reference, topology_.triangles[f], corner, e);
                    use(v, frames[v].leftCols<2>().transpose() * along, weights_[f][corner][e]);
                }
            }
        }
    };
    std::vector<Eigen::Matrix2d> sums(frames.size(), Eigen::Matrix2d::Zero());
    for_each_edge([&](uint32_t v, const Eigen::Vector2d& in_plane, double&) {
        sums[v] += in_plane * in_plane.transpose();
    });
    // w_e = e · u, where Σ_e e eᵀ u is the x axis. A little of the identity keeps edges along one line
    // from having no solution.
    std::vector<Eigen::Vector2d> solutions(frames.size(), Eigen::Vector2d::Zero());
    for (size_t v = 0; v < frames.size(); ++v) {
        const double trace = sums[v].trace();
        if (!(trace > 0.0)) continue;
        const Eigen::Matrix2d scaled = sums[v] / trace + 1e-6 * Eigen::Matrix2d::Identity();
        solutions[v] = scaled.inverse().col(0) / std::sqrt(trace);
    }
    for_each_edge([&](uint32_t v, const Eigen::Vector2d& in_plane, double& weight) {
        const double trace = sums[v].trace();
        weight = trace > 0.0 ? in_plane.dot(solutions[v]) / std::sqrt(trace) : 0.0;
    });
}

std::vector<Eigen::Matrix3f> TangentFrames::at(std::span<const Vec3f> positions) const {
    const std::vector<Vec3f> normals = vertex_normals(topology_, positions);
    std::vector<Vec3d> tangents(positions.size(), Vec3d::Zero());
    std::vector<double> lengths(positions.size(), 0.0);
    for (size_t f = 0; f < topology_.triangles.size(); ++f) {
        const Triangle& t = topology_.triangles[f];
        for (size_t corner = 0; corner < 3; ++corner) {
            for (size_t e = 0; e < 2; ++e) {
                const Vec3d part = weights_[f][corner][e] * edge(positions, t, corner, e);
                tangents[t[corner]] += part;
                lengths[t[corner]] += part.norm();
            }
        }
    }
    std::vector<Eigen::Matrix3f> frames(positions.size(), Eigen::Matrix3f::Identity());
    for (size_t v = 0; v < frames.size(); ++v) {
        if (normals[v].isZero(0.0f)) continue;
        const Vec3d normal = normals[v].cast<double>().normalized();
        const Vec3d relative =
            lengths[v] > 0.0 ? Vec3d(tangents[v] / lengths[v]) : Vec3d(Vec3d::Zero());
        frames[v] = frame_of(unit_in_plane(relative, normal), normal).cast<float>();
    }
    return frames;
}

std::vector<Eigen::Matrix3f> TangentFrames::at(std::span<const Vec3f> positions,
                                               std::span<const Vec3f> normals) const {
    PAIM_CHECK_EQ(positions.size(), normals.size());
    std::vector<Eigen::Matrix3f> frames = at(positions);
    for (size_t v = 0; v < frames.size(); ++v) {
        const Vec3d normal = normals[v].cast<double>().normalized();
        const Vec3d tangent = frames[v].col(0).cast<double>();
        frames[v] =
            normal.isZero(0.0)
                ? Eigen::Matrix3f(Eigen::Matrix3f::Identity())
                : Eigen::Matrix3f(frame_of(unit_in_plane(tangent, normal), normal).cast<float>());
    }
    return frames;
}

}  // namespace paim
