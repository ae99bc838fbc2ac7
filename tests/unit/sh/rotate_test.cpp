// Rotation matrices by identities: orthogonality, composition, and turning the functions
// themselves.
#include "paim/sh/rotate.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "paim/base/gauss_legendre.h"
#include "paim/sh/basis.h"
#include "paim/sh/zonal.h"
#include "tests/unit/sh/directions.h"

namespace paim::sh {
namespace {

Eigen::Matrix3d random_rotation(RandomStream& random) {
    return Eigen::AngleAxisd(2.0 * kPi * random.uniform(), random_direction(random))
        .toRotationMatrix();
}

constexpr int kBands = 32;  // to which 1e-12 is promised

std::vector<Eigen::Matrix3d> test_rotations() {
    RandomStream random(stream_key(11, 0, 0));
    std::vector<Eigen::Matrix3d> rotations;
    for (int i = 0; i < 8; ++i) rotations.push_back(random_rotation(random));
    const auto about = [](double angle_rad, const Vec3d& axis) -> Eigen::Matrix3d {
        return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
    };
    // Where angles and axes degenerate: nothing, quarter and half turns, and next to them.
    for (const double near : {0.0, 1e-15, 1e-9, 1e-5}) {
        for (const double angle : {0.0, kPi / 2.0, kPi}) {
            for (int axis = 0; axis < 3; ++axis) {
                rotations.push_back(about(angle - near, Vec3d::Unit(axis)));
                rotations.push_back(
                    about(angle + near, Vec3d::Unit(axis) + Vec3d(near, near, near)));
            }
        }
        // Half turns about axes for which two elements of the quaternion are alike or one is tiny,
        // and the polar axis almost to the other pole, where two of three Euler angles are one.
        rotations.push_back(about(kPi - near, Vec3d(1, -1, near)));
        rotations.push_back(about(kPi - near, Vec3d(1, 1, 1)));
        rotations.push_back(about(0.7, Vec3d::UnitZ()) * about(kPi - near, Vec3d::UnitY()) *
                            about(-1.1, Vec3d::UnitZ()));
        rotations.push_back(about(0.7, Vec3d::UnitZ()) * about(near, Vec3d::UnitY()) *
                            about(-0.7, Vec3d::UnitZ()));
    }
    return rotations;
}

double largest(const Eigen::MatrixXd& matrix) {
    return matrix.cwiseAbs().maxCoeff();
}

TEST(Rotation, IsOrthogonal) {
    for (const Eigen::Matrix3d& r : test_rotations()) {
        const Rotation rotation(kMaxBands, r);
        for (int l = 0; l < kMaxBands; ++l) {
            const Eigen::MatrixXd& block = rotation.block(l);
            const auto identity = Eigen::MatrixXd::Identity(2 * l + 1, 2 * l + 1);
            // Each band adds a few roundings to the errors of the last; 1e-12 is what users may
            // count on to 32 bands; they grow to 3e-11 at 64.
            const double tolerance = l < kBands ? 1e-12 : 1e-10;
            EXPECT_LT(largest(block * block.transpose() - identity), tolerance) << l;
            EXPECT_LT(largest(block.transpose() * block - identity), tolerance) << l;
        }
    }
}

TEST(Rotation, Composes) {
    // Each with the next, degenerate ones with random ones and among themselves.
    std::vector<Eigen::Matrix3d> rotations = test_rotations();
    const size_t half = rotations.size() / 2;
    for (size_t i = 0; i < rotations.size(); ++i) {
        const Eigen::Matrix3d& a = rotations[i];
        for (const size_t j : {(i + 1) % rotations.size(), (i * i + half) % rotations.size()}) {
            const Eigen::Matrix3d& b = rotations[j];
            const Rotation ra(kBands, a), rb(kBands, b), rab(kBands, a * b);
            for (int l = 0; l < kBands; ++l) {
                // As above; the rounding of a·b turns band l by l · 2^-53 more.
                ASSERT_LT(largest(ra.block(l) * rb.block(l) - rab.block(l)), 1e-12)
                    << l << ": " << i << ", " << j;
            }
        }
    }
}

TEST(Rotation, EqualsProjectingTheTurnedFunctionAgain) {
    // f = Σ c_i y_i of random c; f(R⁻¹ω) y_i(ω) has degree 62 at most: 32 Gauss–Legendre latitudes
    // and 63 equidistant longitudes integrate it exactly.
    constexpr int kLongitudes = 2 * kBands - 1;
    constexpr int kCoefficients = kBands * kBands;
    RandomStream random(stream_key(16, 0, 0));
    std::vector<double> c(kCoefficients), turned(kCoefficients), at(kCoefficients),
        back(kCoefficients);
    const auto as_vector = [](std::vector<double>& values) {
        return Eigen::Map<Eigen::VectorXd>(values.data(), kCoefficients);
    };
    for (double& value : c) value = 2.0 * random.uniform() - 1.0;
    as_vector(c).normalize();
    const auto nodes = gauss_legendre(kBands, -1.0, 1.0);
    for (const Eigen::Matrix3d& r : test_rotations()) {
        Rotation(kBands, r).apply(c, turned);
        Eigen::VectorXd projected = Eigen::VectorXd::Zero(kCoefficients);
        for (const auto& [z, weight] : nodes) {
            const double s = std::sqrt(1.0 - z * z);
            for (int k = 0; k < kLongitudes; ++k) {
                const double phi = 2.0 * kPi * k / kLongitudes;
                const Vec3d direction(s * std::cos(phi), s * std::sin(phi), z);
                evaluate_basis(kBands, direction, at);
                evaluate_basis(kBands, r.transpose() * direction, back);
                projected += weight * (2.0 * kPi / kLongitudes) *
                             as_vector(c).dot(as_vector(back)) * as_vector(at);
            }
        }
        // |c| = 1, so entries of 1e-12 in the blocks and 1e-13 in the basis stay below it.
        EXPECT_LT(largest(as_vector(turned) - projected), 1e-12);
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
