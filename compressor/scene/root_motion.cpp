// The root motion of a pose sequence.
#include "compressor/scene/root_motion.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compressor/scene/rigid_fit.h"
#include "paim/base/parallel.h"
#include "paim/mesh/body_size.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

// More vertices than this are not looked at: they would not change the fit by much.
constexpr size_t kMostPoints = 5000;

// The first pose, from its centre.
struct Reference {
    uint32_t pose = 0;
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
    const std::vector<Vec3f> positions = source.load_positions(p);
    const Vec3d offset = source.pose_offset(p) - reference.centre;
    std::vector<Vec3d> points;
    points.reserve(reference.vertices.size());
    for (const uint32_t v : reference.vertices) {
        points.emplace_back(positions[v].cast<double>() + offset);
    }
    return points;
}

Reference reference_of_pose(const PoseSource& source, uint32_t p) {
    Reference reference;
    reference.pose = p;
    reference.vertices = some_vertices(source.topology());
    reference.points = points_of(source, p, reference);
    if (reference.points.empty()) return reference;
    // Medians, so that an outlier in this pose changes neither.
    reference.centre = median_point(reference.points);
    reference.size = size_of(reference.points);
    for (Vec3d& point : reference.points) point -= reference.centre;
    return reference;
}

// The first pose whose vertices are not one point; the first one if all are.
Reference first_pose_of_size(const PoseSource& source) {
    for (uint32_t p = 0; p < source.num_poses(); ++p) {
        Reference reference = reference_of_pose(source, p);
        if (reference.size > 0.0) return reference;
    }
    return reference_of_pose(source, 0);
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
            // Far from what it is compared with, components are lost in rounding.
            constexpr double kMuchSmaller = 1e-3;
            if (energy < kMuchSmaller * other.energy) return true;
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
        while (k < energies.size() && dropped + energies[k] <= most) {
            dropped += std::max(0.0, energies[k++]);  // rounding may leave less than 0
        }
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

// Rotations that are smaller everywhere follow the shape rather than the body.
constexpr double kLeastTurn_deg = 15.0;

double largest_turn_deg(const RootMotion& motion) {
    double largest = 0.0;
    for (const RigidTransform& root : motion) {
        largest = std::max(largest, rotation_vector(root.rotation).norm() * 180.0 / kPi);
    }
    return largest;
}

// A pose that lies far from the path of the others is an outlier (mesh/outliers.h), and no step of
// the path: it gets the transform between its neighbours. Such are at most two poses, or a
// sixteenth of all, to which a single step leads, and from which another leads back.
void take_out_jumps(const Reference& reference, RootMotion& motion) {
    std::vector<Vec3d> places;
    for (const RigidTransform& root : motion) places.push_back(root.translation);
    const Vec3d median = median_point(places);
    std::vector<double> distances;
    for (const Vec3d& place : places) distances.push_back((place - median).norm());
    std::vector<double> sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    constexpr double kSizes = 10.0;
    const double far = kSizes * (reference.size + sorted[3 * (sorted.size() - 1) / 4]);
    std::vector<size_t> jumps;
    for (size_t p = 0; p < places.size(); ++p) {
        const auto leads_far = [&](size_t q) { return (places[p] - places[q]).norm() > far; };
        if (distances[p] <= far) continue;
        if (p > 0 && distances[p - 1] <= far && !leads_far(p - 1)) continue;
        if (p + 1 < places.size() && distances[p + 1] <= far && !leads_far(p + 1)) continue;
        jumps.push_back(p);
    }
    if (jumps.size() > std::max<size_t>(2, places.size() / 16) || places.size() < 3) return;
    for (const size_t p : jumps) {
        size_t before = p, after = p;
        const auto is_jump = [&](size_t q) {
            return std::find(jumps.begin(), jumps.end(), q) != jumps.end();
        };
        while (before > 0 && is_jump(before)) --before;
        while (after + 1 < motion.size() && is_jump(after)) ++after;
        if (is_jump(before)) before = after;
        if (is_jump(after)) after = before;
        motion[p] = root_at({motion[before], motion[after]}, 0.5);
    }
}

// From the origin of the sequence, in few digits.
RigidTransform rounded(const RigidTransform& root, const Reference& reference,
                       LocalOrigin local_origin) {
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
    Vec3d translation = root.translation + reference.centre;
    if (local_origin == LocalOrigin::reference) translation -= result.rotation * reference.centre;
    result.translation = to_multiples(translation, unit);
    return result;
}

// The choice among taking out nothing (0), translations (1), and rotations as well (2).
// turns  whether the body turns far enough for its transfer to change much
size_t choose(RootMotionChoice choice, const Variants& variants, bool turns) {
    if (choice == RootMotionChoice::translation) return 1;
    if (choice == RootMotionChoice::rigid) return 2;
    size_t best = 0;
    Variants::Cost least = variants.cost_of(best);
    for (const size_t variant : {1, 2}) {
        if (variant == 2 && !turns) continue;
        const Variants::Cost cost = variants.cost_of(variant);
        if (!cost.is_better_than(least)) continue;
        least = cost;
        best = variant;
    }
    return best;
}

}  // namespace

RootMotion find_root_motion(const PoseSource& source, RootMotionChoice choice,
                            const std::function<void()>& on_pose, LocalOrigin local_origin) {
    const uint32_t num_poses = source.num_poses();
    if (choice == RootMotionChoice::none || num_poses < 2) return {};
    const Reference reference = first_pose_of_size(source);
    RootMotion motions[3];
    for (RootMotion& motion : motions) motion.resize(num_poses);
    if (reference.points.empty()) return {};
    // Poses without size have no motion but that of a point.
    if (reference.size == 0.0 && choice == RootMotionChoice::automatic) return {};
    Variants variants(reference, num_poses);
    parallel_for(num_poses, 1, [&](size_t task, size_t) {
        const auto p = static_cast<uint32_t>(task);
        if (p != reference.pose) {
            const std::vector<Vec3d> points = points_of(source, p, reference);
            motions[1][p] = fit_translation(reference.points, points);
            motions[2][p] = fit_rigid(reference.points, points);
            variants.set(p, points, motions[1][p], motions[2][p]);
        }
        if (on_pose) on_pose();
    });
    const bool turns = largest_turn_deg(motions[2]) >= kLeastTurn_deg;
    const size_t chosen = choose(choice, variants, turns);
    if (chosen == 0) return {};
    take_out_jumps(reference, motions[chosen]);
    for (RigidTransform& root : motions[chosen]) root = rounded(root, reference, local_origin);
    return std::move(motions[chosen]);
}

}  // namespace paim
