// The root motion of a pose sequence.
// Based on: Kabsch 1976; Huber 1964 (see the header)
#include "compressor/scene/root_motion.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Each coordinate by itself.
Vec3d median_difference(std::span<const Vec3d> from, std::span<const Vec3d> to) {
    Vec3d median;
    std::vector<double> values(from.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t v = 0; v < from.size(); ++v) values[v] = to[v][axis] - from[v][axis];
        median[axis] = median_of(values);
    }
    return median;
}

// The transform with the smallest weighted sum of squared distances.
RigidTransform fit_weighted(std::span<const Vec3d> from, std::span<const Vec3d> to,
                            std::span<const double> weights, bool with_rotation) {
    double sum = 0.0;
    Vec3d from_centre = Vec3d::Zero(), to_centre = Vec3d::Zero();
    for (size_t v = 0; v < from.size(); ++v) {
        sum += weights[v];
        from_centre += weights[v] * from[v];
        to_centre += weights[v] * to[v];
    }
    from_centre /= sum;
    to_centre /= sum;
    RigidTransform fit;
    if (with_rotation) {
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        for (size_t v = 0; v < from.size(); ++v) {
            covariance += weights[v] * (to[v] - to_centre) * (from[v] - from_centre).transpose();
        }
        // Decides directions that the points do not.
        constexpr double kTowardsIdentity = 1e-12;
        const double size = covariance.norm();
        covariance.diagonal().array() += kTowardsIdentity * size;
        if (size > 0.0 && std::isfinite(size)) {
            const Eigen::JacobiSVD<Eigen::Matrix3d> decomposition(
                covariance / size, Eigen::ComputeFullU | Eigen::ComputeFullV);
            Eigen::Matrix3d signs = Eigen::Matrix3d::Identity();
            signs(2, 2) =
                (decomposition.matrixU() * decomposition.matrixV().transpose()).determinant() < 0.0
                    ? -1
                    : 1;
            const Eigen::Matrix3d rotation =
                decomposition.matrixU() * signs * decomposition.matrixV().transpose();
            fit.rotation = Eigen::Quaterniond(rotation).normalized();
        }
    }
    fit.translation = to_centre - fit.rotation * from_centre;
    return fit;
}

// Whether rounds have come to an end.
// near  a distance between points that counts
bool is_same(const RigidTransform& a, const RigidTransform& b, double near) {
    constexpr double kSame = 1e-12;
    return (a.rotation.coeffs() - b.rotation.coeffs()).norm() <= kSame &&
           (a.translation - b.translation).norm() <= kSame * (near + a.translation.norm());
}

// Iteratively reweighted least squares of Huber's loss.
RigidTransform fit(std::span<const Vec3d> from, std::span<const Vec3d> to, bool with_rotation) {
    PAIM_CHECK_EQ(from.size(), to.size());
    RigidTransform best;
    if (from.empty()) return best;
    best.translation = median_difference(from, to);
    constexpr int kRounds = 100;
    // With this factor, a body whose points are three fifths of all decides.
    constexpr double kQuadraticMedians = 1.5;
    std::vector<double> distances(from.size()), weights(from.size());
    for (int round = 0; round < kRounds; ++round) {
        double largest = 0.0;
        for (size_t v = 0; v < from.size(); ++v) {
            distances[v] = (best.to_scene(from[v]) - to[v]).norm();
            largest = std::max(largest, distances[v]);
        }
        if (largest == 0.0) break;
        // Where most distances are 0, other points hardly count.
        const double near =
            std::max(kQuadraticMedians * median_of(distances), std::numeric_limits<double>::min());
        for (size_t v = 0; v < from.size(); ++v) {
            weights[v] = distances[v] <= near ? 1.0 : near / distances[v];
        }
        const RigidTransform next = fit_weighted(from, to, weights, with_rotation);
        const bool same = is_same(next, best, near);
        best = next;
        if (same) break;
    }
    return best;
}

// More vertices than this are not looked at: they would not change the fit by much.
constexpr size_t kMostPoints = 5000;

// The first pose, from its centre.
struct Reference {
    std::vector<uint32_t> vertices;  // of faces, evenly among all
    std::vector<Vec3d> points;       // of these vertices
    Vec3d centre = Vec3d::Zero();    // relative to the origin of the sequence
    double size = 0.0;               // about the diagonal of the body, scene units
};

std::vector<uint32_t> some_vertices(const Topology& topology) {
    const std::vector<uint32_t> all = face_vertices(topology);
    const size_t step = (all.size() + kMostPoints - 1) / kMostPoints;
    std::vector<uint32_t> some;
    for (size_t j = 0; j < all.size(); j += step) some.push_back(all[j]);
    return some;
}

std::vector<Vec3d> points_of(const PoseSource& source, uint32_t p, const Reference& reference) {
    const Pose pose = source.load_pose(p);
    const Vec3d offset = source.pose_offset(p) - reference.centre;
    std::vector<Vec3d> points;
    points.reserve(reference.vertices.size());
    for (const uint32_t v : reference.vertices) {
        points.emplace_back(pose.positions[v].cast<double>() + offset);
    }
    return points;
}

Reference first_pose(const PoseSource& source) {
    Reference reference;
    reference.vertices = some_vertices(source.topology());
    reference.points = points_of(source, 0, reference);
    if (reference.points.empty()) return reference;
    // Medians, so that an outlier in this pose changes neither.
    const std::vector<Vec3d> at_origin(reference.points.size(), Vec3d::Zero());
    reference.centre = median_difference(at_origin, reference.points);
    std::vector<double> squares;
    for (Vec3d& point : reference.points) {
        point -= reference.centre;
        squares.push_back(point.squaredNorm());
    }
    // Of points that are spread evenly in a box, the median lies at a quarter of its diagonal.
    constexpr double kMedians = 4.0;
    reference.size = kMedians * std::sqrt(median_of(std::move(squares)));
    return reference;
}

// The poses as they are, without translations, and without translations and rotations: columns of
// differences from the first pose.
class Variants {
  public:
    Variants(const Reference& reference, uint32_t num_poses)
        : reference_(reference),
          pose_step_((num_poses + kMostPosesCounted - 1) / kMostPosesCounted),
          point_step_((reference.points.size() + kMostPointsCounted - 1) / kMostPointsCounted) {
        const auto num_points =
            static_cast<Eigen::Index>((reference.points.size() + point_step_ - 1) / point_step_);
        const auto num_columns =
            static_cast<Eigen::Index>((num_poses + pose_step_ - 1) / pose_step_);
        for (auto& matrix : matrices_) matrix.setZero(3 * num_points, num_columns);
    }

    // Different poses may be set by different threads.
    void set(uint32_t p, std::span<const Vec3d> points, const RigidTransform& translated,
             const RigidTransform& moved) {
        if (p % pose_step_ != 0) return;
        Eigen::Index row = 0;
        for (size_t v = 0; v < points.size(); v += point_step_, row += 3) {
            const Vec3d& first = reference_.points[v];
            const Vec3d near = clipped(translated.to_local(points[v]) - first);
            const auto entry = [&](size_t variant) {
                return matrices_[variant].block<3, 1>(row, p / pose_step_);
            };
            entry(0) = near + translated.translation;
            entry(1) = near;
            entry(2) = clipped(moved.to_local(points[v]) - first);
        }
    }

    struct Cost {
        uint32_t num_components = 0;  // that leave a thousandth of the body's size as RMS distance
        double energy = 0.0;          // sum of all squares about the mean

        bool is_better_than(const Cost& other) const {
            if (num_components != other.num_components) {
                return num_components < other.num_components;
            }
            return energy < 0.5 * other.energy;
        }
    };
    Cost cost_of(size_t variant) const {
        constexpr double kVisible = 1e-3;
        const Eigen::MatrixXd& matrix = matrices_[variant];
        const Eigen::MatrixXd centred = matrix.colwise() - matrix.rowwise().mean();
        const Eigen::MatrixXd gram = centred.transpose() * centred;
        const Eigen::VectorXd energies =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram, Eigen::EigenvaluesOnly)
                .eigenvalues();  // ascending
        const double visible = kVisible * reference_.size;
        const double most = visible * visible * static_cast<double>(matrix.size()) / 3.0;
        double dropped = 0.0;
        Eigen::Index k = 0;
        while (k < energies.size() && dropped + energies[k] <= most) dropped += energies[k++];
        return {static_cast<uint32_t>(energies.size() - k), centred.squaredNorm()};
    }

  private:
    static constexpr size_t kMostPosesCounted = 400;
    static constexpr size_t kMostPointsCounted = 1000;

    // An outlier counts as if it were only as far as the body is large.
    Vec3d clipped(const Vec3d& difference) const {
        const double length = difference.stableNorm();
        if (!(length > reference_.size)) return difference;
        return reference_.size / length * difference;
    }

    const Reference& reference_;
    const size_t pose_step_, point_step_;
    Eigen::MatrixXd matrices_[3];
};

// From the origin of the sequence, in few digits.
RigidTransform rounded(const RigidTransform& root, const Reference& reference) {
    const auto to_multiples = [](const Vec3d& numbers, double unit) {
        return Vec3d((numbers / unit).array().round().matrix() * unit);
    };
    RigidTransform result;
    Vec3d turn = to_multiples(rotation_vector(root.rotation), kRotationUnit_rad);
    // No more than half a turn, which would be less than half a turn the other way.
    while (!(turn.norm() < kPi)) {
        Eigen::Index axis = 0;
        turn.cwiseAbs().maxCoeff(&axis);
        turn[axis] -= std::copysign(kRotationUnit_rad, turn[axis]);
    }
    result.rotation = rotation_of(turn);
    const double size = reference.size > 0.0 ? reference.size : 1.0;
    const double unit = std::ldexp(kRotationUnit_rad, std::ilogb(size));
    result.translation = to_multiples(root.translation + reference.centre, unit);
    return result;
}

// The choice among taking out nothing (0), translations (1), and rotations as well (2).
size_t choose(RootMotionChoice choice, const Variants& variants) {
    if (choice == RootMotionChoice::translation) return 1;
    if (choice == RootMotionChoice::rigid) return 2;
    size_t best = 0;
    Variants::Cost least = variants.cost_of(best);
    for (const size_t variant : {1, 2}) {
        const Variants::Cost cost = variants.cost_of(variant);
        if (!cost.is_better_than(least)) continue;
        least = cost;
        best = variant;
    }
    return best;
}

}  // namespace

RigidTransform fit_rigid(std::span<const Vec3d> from, std::span<const Vec3d> to) {
    return fit(from, to, true);
}

RigidTransform fit_translation(std::span<const Vec3d> from, std::span<const Vec3d> to) {
    return fit(from, to, false);
}

RootMotion find_root_motion(const PoseSource& source, RootMotionChoice choice,
                            const std::function<void()>& on_pose) {
    const uint32_t num_poses = source.num_poses();
    if (choice == RootMotionChoice::none || num_poses < 2) return {};
    const Reference reference = first_pose(source);
    RootMotion motions[3];
    for (RootMotion& motion : motions) motion.resize(num_poses);
    if (reference.points.empty()) return {};
    // A first pose without size says nothing about the others.
    if (reference.size == 0.0 && choice == RootMotionChoice::automatic) return {};
    Variants variants(reference, num_poses);
    parallel_for(num_poses, 1, [&](size_t task, size_t) {
        const auto p = static_cast<uint32_t>(task);
        if (p > 0) {
            const std::vector<Vec3d> points = points_of(source, p, reference);
            motions[1][p] = fit_translation(reference.points, points);
            motions[2][p] = fit_rigid(reference.points, points);
            variants.set(p, points, motions[1][p], motions[2][p]);
        }
        if (on_pose) on_pose();
    });
    const size_t chosen = choose(choice, variants);
    if (chosen == 0) return {};
    for (RigidTransform& root : motions[chosen]) root = rounded(root, reference);
    return std::move(motions[chosen]);
}

}  // namespace paim
