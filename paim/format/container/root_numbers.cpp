// A root motion as numbers of a file.
#include "paim/format/container/root_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim {

namespace {

// The multiple of the unit that rounding has moved `value` from, or the value itself.
double without_rounding(double value) {
    const double multiple = std::round(value / kRotationUnit_rad) * kRotationUnit_rad;
    constexpr double kRounding = 1e-13;
    return std::abs(value - multiple) < kRounding ? multiple : value;
}

}  // namespace

std::vector<double> root_numbers(const RootMotion& motion) {
    std::vector<double> numbers;
    numbers.reserve(kRootNumbers * motion.size());
    for (const RigidTransform& root : motion) {
        const Vec3d r = rotation_vector(root.rotation).unaryExpr(&without_rounding);
        const Vec3d& t = root.translation;
        numbers.insert(numbers.end(), {r.x(), r.y(), r.z(), t.x(), t.y(), t.z()});
    }
    return numbers;
}

RootMotion root_motion_of(const std::vector<double>& numbers, const std::string& file) {
    constexpr double kMost = std::numeric_limits<float>::max();
    constexpr double kHalfTurn = 1.001 * kPi;
    PAIM_CHECK_EQ(numbers.size() % kRootNumbers, 0u);
    RootMotion motion(numbers.size() / kRootNumbers);
    for (size_t p = 0; p < motion.size(); ++p) {
        const double* const n = numbers.data() + kRootNumbers * p;
        const Vec3d vector(n[0], n[1], n[2]);
        if (!(vector.stableNorm() <= kHalfTurn)) {
            throw_bad_input(
                "{}: root motion of pose {}: a rotation by {} radians, expected at most "
                "{}",
                file, p, vector.stableNorm(), kHalfTurn);
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(n[3 + axis]) <= kMost) continue;
            throw_bad_input("{}: root motion of pose {}: a translation of {}, expected at most {}",
                            file, p, n[3 + axis], kMost);
        }
        motion[p] = {rotation_of(vector), {n[3], n[4], n[5]}};
    }
    return motion;
}

void check_floor(const Topology& topology, uint32_t num_following, const std::string& file) {
    const std::vector<Triangle>& triangles = topology.triangles;
    for (size_t j = topology.num_triangles_before(num_following); j < triangles.size(); ++j) {
        if (std::ranges::min(triangles[j]) >= num_following) continue;
        throw_bad_input(
            "{}: triangle {} follows the root motion, expected it before those of the floor", file,
            j);
    }
}

}  // namespace paim
