// Rotation matrices by identities: orthogonality, composition, and turning the functions
// themselves.
#include "paim/sh/rotate.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "paim/sh/basis.h"
#include "paim/sh/zonal.h"
#include "tests/unit/sh/directions.h"

namespace paim::sh {
namespace {

Eigen::Matrix3d random_rotation(RandomStream& random) {
    return Eigen::AngleAxisd(2.0 * kPi * random.uniform(), random_direction(random))
        .toRotationMatrix();
}

std::vector<Eigen::Matrix3d> test_rotations() {
    RandomStream random(stream_key(11, 0, 0));
    std::vector<Eigen::Matrix3d> rotations;
    for (int i = 0; i < 8; ++i) rotations.push_back(random_rotation(random));
    // Quarter and half turns, and one that is almost nothing.
    for (int axis = 0; axis < 3; ++axis) {
        rotations.push_back(Eigen::AngleAxisd(kPi / 2.0, Vec3d::Unit(axis)).toRotationMatrix());
        rotations.push_back(Eigen::AngleAxisd(kPi, Vec3d::Unit(axis)).toRotationMatrix());
    }
    rotations.push_back(Eigen::AngleAxisd(1e-9, Vec3d(1, 2, 3).normalized()).toRotationMatrix());
    return rotations;
}

TEST(Rotation, IsOrthogonal) {
    for (const Eigen::Matrix3d& r : test_rotations()) {
        const Rotation rotation(kMaxBands, r);
        for (int l = 0; l < kMaxBands; ++l) {
            const Eigen::MatrixXd& block = rotation.block(l);
            const double error =
                (block * block.transpose() - Eigen::MatrixXd::Identity(2 * l + 1, 2 * l + 1))
                    .cwiseAbs()
                    .maxCoeff();
            // Each band adds a few roundings to the errors of the last; 1e-12 is what users may
            // count on to 32 bands; they grow to 3e-11 at 64.
            EXPECT_LT(error, l < 32 ? 1e-12 : 1e-10) << l;
        }
    }
}

TEST(Rotation, Composes) {
    RandomStream random(stream_key(12, 0, 0));
    for (int trial = 0; trial < 4; ++trial) {
        const Eigen::Matrix3d a = random_rotation(random);
        const Eigen::Matrix3d b = random_rotation(random);
        const Rotation ra(32, a), rb(32, b), rab(32, a * b);
        for (int l = 0; l < 32; ++l) {
            // As above; the rounding of a·b turns band l by l · 2^-53 more.
            EXPECT_LT((ra.block(l) * rb.block(l) - rab.block(l)).cwiseAbs().maxCoeff(), 1e-12);
        }
    }
}

TEST(Rotation, OfIdentityIsIdentity) {
    const Rotation rotation(kMaxBands, Eigen::Matrix3d::Identity());
    for (int l = 0; l < kMaxBands; ++l) {
        // Exact but for the square roots of the recursion, one rounding a band.
        EXPECT_LT((rotation.block(l) - Eigen::MatrixXd::Identity(2 * l + 1, 2 * l + 1))
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-13);
    }
}

TEST(Rotation, TurnsTheFunction) {
    // f = Σ c_i y_i; f'(ω) = f(R⁻¹ω) for any coefficients means: M c · y(ω) = c · y(R⁻¹ω), so
    // Mᵀ y(ω) = y(R⁻¹ω), entry by entry.
    RandomStream random(stream_key(13, 0, 0));
    constexpr int kBands = 32;
    std::vector<double> at(kBands * kBands), back(kBands * kBands);
    for (const Eigen::Matrix3d& r : test_rotations()) {
        const Rotation rotation(kBands, r);
        for (int trial = 0; trial < 10; ++trial) {
            const Vec3d direction = random_direction(random);
            evaluate_basis(kBands, direction, at);
            evaluate_basis(kBands, r.transpose() * direction, back);
            for (int l = 0; l < kBands; ++l) {
                const Eigen::Map<const Eigen::VectorXd> y(at.data() + index(l, -l), 2 * l + 1);
                const Eigen::Map<const Eigen::VectorXd> expected(back.data() + index(l, -l),
                                                                 2 * l + 1);
                const double error =
                    (rotation.block(l).transpose() * y - expected).cwiseAbs().maxCoeff();
                // The blocks' 1e-12 and the basis' 1e-13 of sqrt(63/4π).
                EXPECT_LT(error, 3e-12) << l;
            }
        }
    }
}

TEST(Rotation, TurnsZonalFunctionsToTheirNewAxis) {
    const std::vector<double> zonal = cone_zonal(16, 0.4);
    std::vector<double> out(256);
    const std::vector<double> in = zonal_to_axis(zonal, Vec3d::UnitZ());
    for (const Eigen::Matrix3d& r : test_rotations()) {
        Rotation(16, r).apply(in, out);
        const std::vector<double> expected = zonal_to_axis(zonal, r * Vec3d::UnitZ());
        for (size_t i = 0; i < 256; ++i) EXPECT_NEAR(out[i], expected[i], 1e-12);
    }
}

TEST(Rotation, AppliesToFloatsAsToDoubles) {
    RandomStream random(stream_key(14, 0, 0));
    const Rotation rotation(7, random_rotation(random));
    std::vector<float> in(49), out(49);
    std::vector<double> in_double(49), out_double(49);
    for (size_t i = 0; i < 49; ++i) {
        in[i] = static_cast<float>(random.uniform() - 0.5);
        in_double[i] = in[i];
    }
    rotation.apply(in, out);
    rotation.apply(in_double, out_double);
    for (size_t i = 0; i < 49; ++i) EXPECT_EQ(out[i], static_cast<float>(out_double[i]));
}

TEST(Rotation, ForgivesRoundedMatrices) {
    // A rotation kept in float is off by 1e-7; band 63 must not be off by more than its angle does,
    // 63 · 1e-7 times a few, and stays orthogonal.
    RandomStream random(stream_key(15, 0, 0));
    const Eigen::Matrix3d r = random_rotation(random);
    const Rotation exact(kMaxBands, r);
    const Rotation rounded(kMaxBands, r.cast<float>().cast<double>());
    const Eigen::MatrixXd& block = rounded.block(63);
    EXPECT_LT(
        (block * block.transpose() - Eigen::MatrixXd::Identity(127, 127)).cwiseAbs().maxCoeff(),
        1e-10);
    EXPECT_LT((block - exact.block(63)).cwiseAbs().maxCoeff(), 2e-5);
}

TEST(RotationDeathTest, RefusesWhatIsNoRotation) {
    EXPECT_DEATH(Rotation(3, 1.001 * Eigen::Matrix3d::Identity()), "check failed");
    EXPECT_DEATH(Rotation(3, -Eigen::Matrix3d::Identity()), "check failed.*determinant");
    const Rotation rotation(2, Eigen::Matrix3d::Identity());
    std::vector<double> values(4);
    EXPECT_DEATH(rotation.apply(std::span<const double>(values), std::span<double>(values)),
                 "check failed");
    EXPECT_DEATH(rotation.apply(std::vector<double>(9), values), "check failed.*size");
}

}  // namespace
}  // namespace paim::sh
