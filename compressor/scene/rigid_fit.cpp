// The rigid transform between two sets of points.
// Based on: Kabsch 1976; Huber 1964 (see the header)
#include "compressor/scene/rigid_fit.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/check.h"
#include "paim/base/median.h"
#include "paim/mesh/body_size.h"

namespace paim {

// Each coordinate by itself.
Vec3d median_difference(std::span<const Vec3d> from, std::span<const Vec3d> to) {
    Vec3d result;
    std::vector<double> values(from.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t v = 0; v < from.size(); ++v) values[v] = to[v][axis] - from[v][axis];
        result[axis] = median(values);
    }
    return result;
}

namespace {

// The transform with the smallest weighted sum of squared distances.
RigidTransform fit_weighted(std::span<const Vec3d> from, std::span<const Vec3d> to,
                            std::span<const double> weights) {
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
            (decomposition.matrixU() * decomposition.matrixV().transpose()).determinant() < 0.0 ? -1
                                                                                                : 1;
        const Eigen::Matrix3d rotation =
            decomposition.matrixU() * signs * decomposition.matrixV().transpose();
        fit.rotation = Eigen::Quaterniond(rotation).normalized();
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

}  // namespace

// Iteratively reweighted least squares of Huber's loss.
RigidTransform fit_rigid(std::span<const Vec3d> from, std::span<const Vec3d> to) {
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
            std::max(kQuadraticMedians * median(distances), std::numeric_limits<double>::min());
        for (size_t v = 0; v < from.size(); ++v) {
            weights[v] = distances[v] <= near ? 1.0 : near / distances[v];
        }
        const RigidTransform next = fit_weighted(from, to, weights);
        const bool same = is_same(next, best, near);
        best = next;
        if (same) break;
    }
    return best;
}

RigidTransform fit_translation(std::span<const Vec3d> from, std::span<const Vec3d> to) {
    PAIM_CHECK_EQ(from.size(), to.size());
    RigidTransform fit;
    if (from.empty()) return fit;
    const Vec3d middle = median_difference(from, to);
    const double size = size_of(from);
    Vec3d sum = Vec3d::Zero();
    double count = 0.0;
    for (size_t v = 0; v < from.size(); ++v) {
        const Vec3d difference = to[v] - from[v];
        if ((difference - middle).stableNorm() > size) continue;
        sum += difference - middle;
        count += 1.0;
    }
    fit.translation = count > 0.0 ? Vec3d(middle + sum / count) : middle;
    return fit;
}

}  // namespace paim
