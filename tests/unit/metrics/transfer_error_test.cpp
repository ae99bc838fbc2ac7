// The error of a decoded transfer: from the bake exactly, from the truth as far as it can be known.
#include "paim/metrics/transfer_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "paim/base/tbb_parallel.h"
#include "paim/metrics/pose_space.h"
#include "tests/unit/metrics/random_planes.h"

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

// Data matrices: rows plane-major, a column a pose.
struct Animation {
    TransferLayout layout;
    Index num_vertices = 0;
    MatrixXf baked, noise, decoded;

    Index num_poses() const { return baked.cols(); }
    auto plane(const MatrixXf& matrix, Index j) const {
        return matrix.middleRows(j * num_vertices, num_vertices);
    }
};

Animation random_animation(const TransferLayout& layout, Index num_vertices, Index num_poses) {
    const Index rows = static_cast<Index>(layout.num_planes()) * num_vertices;
    const MatrixXd baked = gaussian(rows, num_poses, 1);
    return {layout, num_vertices, baked.cast<float>(),
            (0.1 * gaussian(rows, num_poses, 2)).cast<float>(),
            (baked + 0.2 * gaussian(rows, num_poses, 3)).cast<float>()};
}

TransferErrorMeter new_meter(const Animation& a, const BandPower& spectrum, const MatrixXd& span) {
    return {a.layout, static_cast<uint32_t>(a.num_vertices), static_cast<uint32_t>(a.num_poses()),
            spectrum, span};
}

TransferError measure(const Animation& a, const BandPower& spectrum, const MatrixXd& span) {
    TransferErrorMeter meter = new_meter(a, spectrum, span);
    for (uint32_t j = 0; j < a.layout.num_planes(); ++j) {
        const auto plane = static_cast<Index>(j);
        meter.survey(j, a.plane(a.baked, plane), a.plane(a.noise, plane));
    }
    for (uint32_t j = 0; j < a.layout.num_planes(); ++j) {
        const auto plane = static_cast<Index>(j);
        meter.add(j, a.plane(a.baked, plane), a.plane(a.noise, plane), a.plane(a.decoded, plane));
    }
    return meter.result();
}

// A decoder that can follow anything.
MatrixXd every_pose(Index num_poses) {
    const MatrixXf identity = MatrixXf::Identity(num_poses, num_poses);
    return orthonormal_pose_space({identity.data(), static_cast<size_t>(identity.size())},
                                  static_cast<uint32_t>(num_poses));
}

MatrixXd mean_only(Index num_poses) {
    return orthonormal_pose_space({}, static_cast<uint32_t>(num_poses));
}

double squared(const MatrixXf& matrix) {
    return matrix.cast<double>().squaredNorm();
}

TEST(TransferError, OfFlatLightIsTheRelativeFrobeniusError) {
    const Animation a = random_animation({TransferKind::diffuse, 3, 3}, 300, 7);
    const TransferError error = measure(a, BandPower::flat(3), every_pose(7));
    const double baked = squared(a.baked);
    const double deviation = (a.decoded.cast<double>() - a.baked.cast<double>()).squaredNorm();
    // Sums of 57,000 squares in double, in another order.
    EXPECT_NEAR(error.error_to_bake / std::sqrt(deviation / baked), 1.0, 1e-13);
    EXPECT_NEAR(error.bake_noise / std::sqrt(squared(a.noise) / baked), 1.0, 1e-13);
    EXPECT_EQ(error.missing_bands, 0.0);
    EXPECT_EQ(error.total(), error.error);
}

// One vertex, two poses, two bands: everything by hand. Band 1 weighs a quarter under natural
// light.
TEST(TransferError, WeighsBandsByTheLight) {
    Animation a{{TransferKind::diffuse, 2, 1}, 1, MatrixXf(4, 2), MatrixXf(4, 2), MatrixXf(4, 2)};
    a.baked << 3, 1, 2, 0, 0, 2, 2, 0;    // ‖y‖² = 10 and 12
    a.decoded << 2, 1, 2, 0, 2, 2, 2, 0;  // off by 1² and 2²
    a.noise << 1, 0, 0, 2, 0, 0, 0, 0;    // 1 and 4
    const TransferError flat = measure(a, BandPower::flat(2), mean_only(2));
    const TransferError natural = measure(a, BandPower::natural(), mean_only(2));
    // Roundings of a few numbers.
    EXPECT_NEAR(flat.error_to_bake, std::sqrt(5.0 / 22.0), 1e-15);
    EXPECT_NEAR(natural.error_to_bake, std::sqrt(2.0 / 13.0), 1e-15);
    EXPECT_NEAR(flat.bake_noise, std::sqrt(5.0 / 22.0), 1e-15);
    EXPECT_NEAR(natural.bake_noise, std::sqrt(2.0 / 13.0), 1e-15);
    EXPECT_EQ(natural.bands[0].baked, 10.0);
    EXPECT_EQ(natural.bands[1].error_to_bake, 4.0);
}

// Bands that the bake lacks are extrapolated from the signal in its last band, of all
// vertices, poses and channels. Those here end before band 3, so that the last one alone tells the
// amplitude.
TEST(TransferError, ExtrapolatesTheSignalOfTheLastBand) {
    Animation a{{TransferKind::diffuse, 2, 3}, 2, MatrixXf(24, 2), MatrixXf(24, 2), {}};
    a.noise.setZero();
    for (Index j = 0; j < 12; ++j) {
        const bool first_band = j % 4 == 0;
        a.baked.middleRows(2 * j, 2).setConstant(first_band ? 5.0f : 2.0f);
        a.noise.middleRows(2 * j, 2).setConstant(first_band ? 3.0f : 1.0f);
    }
    a.decoded = a.baked;
    // Two vertices in two poses: 4 · 3 · 5² in band 0; 4 · 9 · 2² in band 1, of which 4 · 9 are
    // noise.
    const BandPower light{"x", {1, 0.5, 3, 2}, 0.0};
    const TransferError error = measure(a, light, every_pose(2));
    const double amplitude = (144.0 - 36.0) * 1.5 * 1.5;
    const double missing = amplitude * (3.0 / (2.5 * 2.5) + 2.0 / (3.5 * 3.5));
    // Roundings of a few numbers.
    EXPECT_NEAR(error.missing_bands, std::sqrt(missing / (300.0 + 0.5 * 144.0)), 1e-14);
    // Where there is nothing but noise, nothing is extrapolated.
    a.noise *= 2.5f;
    EXPECT_EQ(measure(a, light, every_pose(2)).missing_bands, 0.0);
}

// The definition: radiance under random lights, whose coefficients have the spectrum's variances.
TEST(TransferError, IsTheErrorOfRadianceUnderRandomLights) {
    const TransferLayout layout{TransferKind::diffuse, 3, 3};
    const Animation a = random_animation(layout, 40, 3);
    const MatrixXd y = a.baked.cast<double>();
    const MatrixXd difference = a.decoded.cast<double>() - y;
    for (const BandPower& spectrum : {BandPower::flat(3), BandPower::natural()}) {
        constexpr int kLights = 4000;
        double sums[2] = {}, squares[2] = {};
        for (int n = 0; n < kLights; ++n) {
            const MatrixXd light = gaussian(9, 3, stream_key(9, static_cast<uint64_t>(n), 0));
            // ‖radiance‖² over vertices, poses and channels: of what is off, and of all.
            const MatrixXd* const transfers[2] = {&difference, &y};
            for (int j = 0; j < 2; ++j) {
                double energy = 0.0;
                for (Index c = 0; c < 3; ++c) {
                    MatrixXd radiance = MatrixXd::Zero(a.num_vertices, a.num_poses());
                    for (Index i = 0; i < 9; ++i) {
                        const double w = spectrum.weight(
                            static_cast<uint32_t>(sh::band_of(static_cast<int>(i))));
                        radiance +=
                            std::sqrt(w) * light(i, c) *
                            transfers[j]->middleRows((9 * c + i) * a.num_vertices, a.num_vertices);
                    }
                    energy += radiance.squaredNorm();
                }
                sums[j] += energy / kLights;
                squares[j] += energy * energy / kLights;
            }
        }
        // Standard error of the ratio, as if both were independent, which is more than it has.
        const double measured = measure(a, spectrum, every_pose(3)).error_to_bake;
        double relative_variance = 0.0;
        for (int j = 0; j < 2; ++j) {
            relative_variance += (squares[j] / (sums[j] * sums[j]) - 1.0) / kLights;
        }
        // 4 standard errors, of the square's half that a root has.
        EXPECT_NEAR(std::sqrt(sums[0] / sums[1]) / measured, 1.0,
                    0.5 * 4.0 * std::sqrt(relative_variance))
            << spectrum.name;
        EXPECT_LT(std::sqrt(relative_variance), 0.02) << "else this would not say much";
    }
}

TEST(TransferError, KeepingEverythingLeavesTheBakesNoise) {
    Animation a = random_animation({TransferKind::diffuse, 2, 1}, 500, 9);
    a.decoded = a.baked;
    const TransferError error = measure(a, BandPower::natural(), every_pose(9));
    EXPECT_EQ(error.error_to_bake, 0.0);
    // Products with the span are floats.
    EXPECT_NEAR(error.error / error.bake_noise, 1.0, 1e-6);
    EXPECT_EQ(error.total(), std::hypot(error.error, error.missing_bands));
    EXPECT_GT(error.missing_bands, 0.0);
}

TEST(TransferError, DecodingNothingLosesTheSignalAndTheNoise) {
    Animation a = random_animation({TransferKind::diffuse, 2, 1}, 500, 9);
    a.decoded.setZero();
    const TransferError error = measure(a, BandPower::flat(2), every_pose(9));
    EXPECT_EQ(error.error_to_bake, 1.0);
    // √(‖y‖² − ‖d‖²) / ‖y‖, to roundings of sums.
    EXPECT_NEAR(error.error, std::sqrt(1.0 - squared(a.noise) / squared(a.baked)), 1e-13);
}

// A band that is not kept loses its signal, the others keep theirs.
TEST(TransferError, CountsBandsThatAreNotKept) {
    Animation a = random_animation({TransferKind::diffuse, 2, 1}, 300, 5);
    a.decoded = a.baked;
    a.decoded.bottomRows(3 * a.num_vertices).setZero();
    const TransferError error = measure(a, BandPower::flat(2), every_pose(5));
    EXPECT_EQ(error.bands[0].error_to_bake, 0.0);
    EXPECT_EQ(error.bands[1].error_to_bake, error.bands[1].baked);
    EXPECT_EQ(error.bands[1].noise_covariance, 0.0);
    const double expected = error.bands[0].noise + error.bands[1].baked - error.bands[1].noise;
    // Products with the span are floats.
    EXPECT_NEAR(error.error, std::sqrt(expected / squared(a.baked)), 1e-6);
}

// Signal of rank 4 and noise that grows with the vertex, both known; decoded as projections and as
// projections that are scaled down by their share of noise, differently for each vertex.
class KnownTruth : public testing::Test {
  protected:
    static constexpr Index kVertices = 12'000, kPoses = 24, kRank = 4;

    // most_noise  standard deviation at the last vertex
    void make(double most_noise) {
        const Index rows = 4 * kVertices;
        sigma_.resize(rows);
        for (Index r = 0; r < rows; ++r)
            sigma_(r) = most_noise * static_cast<double>(r % kVertices) / kVertices;
        movements_ = gaussian(kPoses, kRank, 11).householderQr().householderQ() *
                     MatrixXd::Identity(kPoses, kRank);
        truth_ = 3.0 * gaussian(rows, kRank, 12) * movements_.transpose();
        truth_.colwise() += gaussian(rows, 1, 13).col(0);
        bake_ = truth_ + sigma_.asDiagonal() * gaussian(rows, kPoses, 14);
        animation_ = {{TransferKind::diffuse, 2, 1},
                      kVertices,
                      bake_.cast<float>(),
                      (sigma_.asDiagonal() * gaussian(rows, kPoses, 15)).cast<float>(),
                      {}};
        const MatrixXf weights = movements_.cast<float>();
        kept_ = orthonormal_pose_space({weights.data(), static_cast<size_t>(weights.size())},
                                       static_cast<uint32_t>(kPoses));
    }

    void expect_true_error(const MatrixXd& decoded, const char* what) {
        animation_.decoded = decoded.cast<float>();
        const TransferError error = measure(animation_, BandPower::flat(2), kept_);
        const double true_energy = (decoded - truth_).squaredNorm();
        // By chance: |d|² and |n|² are sums of squares of normal numbers of variance σ², and
        // ⟨t̂ − t, n⟩ one of products with a fixed part of at most ‖t‖; the former counted twice in
        // tr cov. Five standard deviations of all.
        const double variance = 4.0 * 2.0 * sigma_.array().pow(4).sum() * kPoses +
                                4.0 * (sigma_.asDiagonal() * (decoded - truth_)).squaredNorm();
        const double spread = 5.0 * std::sqrt(variance) / squared(animation_.baked);
        // And the floats' rounding, 2^-24 of everything.
        const double expected = true_energy / squared(animation_.baked);
        EXPECT_NEAR(error.error * error.error, expected, spread + 1e-6 * expected) << what;
        EXPECT_LT(spread / expected, 0.2) << "else this would not say much";
    }

    Eigen::VectorXd sigma_;
    MatrixXd movements_, truth_, bake_, kept_;
    Animation animation_;
};

TEST_F(KnownTruth, IsMetByWhatIsExpected) {
    make(0.5);
    const MatrixXd projector = kept_ * kept_.transpose();
    expect_true_error(bake_ * projector, "projected");
    const MatrixXd mean = bake_.rowwise().mean().replicate(1, kPoses);
    expect_true_error(mean, "still");
}

TEST_F(KnownTruth, IsMetWhereVerticesAreShrunkDifferently) {
    make(6.0);
    // Wiener's factors, 9 of signal in each direction: 1 … 1/5.
    const Eigen::VectorXd factors = (9.0 / (9.0 + sigma_.array().square())).matrix();
    const MatrixXd mean = bake_.rowwise().mean().replicate(1, kPoses);
    const MatrixXd moved = (bake_ - mean) * kept_ * kept_.transpose();
    expect_true_error(mean + factors.asDiagonal() * moved, "shrunk");
}

TEST(TransferError, FindsTheWorstVertexAndPose) {
    Animation a{{TransferKind::diffuse, 1, 1}, 3, MatrixXf(3, 2), MatrixXf::Zero(3, 2), {}};
    a.baked << 1, 1, 2, 2, 2, 2;  // ‖y_v‖² = 2, 8, 8: RMS √6; ‖y_p‖² = 9 each
    a.decoded = a.baked;
    a.decoded(1, 0) += 2;
    a.decoded(2, 1) += 1;
    a.decoded(2, 0) -= 1;
    const TransferError error = measure(a, BandPower::flat(1), every_pose(2));
    EXPECT_EQ(error.worst_vertex, 1u);
    EXPECT_NEAR(error.worst_vertex_error_to_bake, std::sqrt(4.0 / 6.0), 1e-15);
    EXPECT_EQ(error.worst_pose, 0u);
    EXPECT_NEAR(error.worst_pose_error_to_bake, std::sqrt(5.0 / 9.0), 1e-15);
}

// Two vertices, two poses, two bands; natural light gives band 1 a quarter of band 0. Without it,
// the other vertex and the other pose would be the worst.
TEST(TransferError, WeighsTheWorstVertexAndPoseByTheLight) {
    Animation a{{TransferKind::diffuse, 2, 1}, 2, MatrixXf(8, 2), MatrixXf::Zero(8, 2), {}};
    a.baked.setConstant(2.0f);  // ‖y‖²_w = 4 · 4 · (1 + 3/4) = 28
    a.decoded = a.baked;
    a.decoded(0, 0) += 2.0f;  // band 0, vertex 0, pose 0: 4
    a.decoded(3, 1) += 3.0f;  // band 1, vertex 1, pose 1: 9, or 9/4 under this light
    const TransferError natural = measure(a, BandPower::natural(), every_pose(2));
    EXPECT_EQ(natural.worst_vertex, 0u);
    EXPECT_EQ(natural.worst_pose, 0u);
    // Relative to the RMS of two vertices, or poses. Roundings of a few numbers.
    EXPECT_NEAR(natural.worst_vertex_error_to_bake, std::sqrt(4.0 / 14.0), 1e-15);
    EXPECT_NEAR(natural.worst_pose_error_to_bake, std::sqrt(4.0 / 14.0), 1e-15);
    const TransferError flat = measure(a, BandPower::flat(2), every_pose(2));
    EXPECT_EQ(flat.worst_vertex, 1u);
    EXPECT_EQ(flat.worst_pose, 1u);
    EXPECT_NEAR(flat.worst_vertex_error_to_bake, std::sqrt(9.0 / 32.0), 1e-15);
    EXPECT_NEAR(flat.worst_pose_error_to_bake, std::sqrt(9.0 / 32.0), 1e-15);
}

TEST(TransferError, OfNumbersThatAreNoneIsNone) {
    Animation a = random_animation({TransferKind::diffuse, 1, 1}, 4, 3);
    a.decoded(2, 1) = std::numeric_limits<float>::quiet_NaN();
    const TransferError error = measure(a, BandPower::flat(1), every_pose(3));
    EXPECT_TRUE(std::isnan(error.error_to_bake));
    EXPECT_TRUE(std::isnan(error.error));
    EXPECT_TRUE(std::isnan(error.worst_vertex_error_to_bake));
    EXPECT_EQ(error.worst_vertex, 2u);
    EXPECT_EQ(error.worst_pose, 1u);
}

TEST(TransferError, OfNothingIsNothingOrInfinite) {
    Animation a = random_animation({TransferKind::diffuse, 2, 1}, 4, 3);
    a.baked.setZero();
    a.noise.setZero();
    EXPECT_TRUE(std::isinf(measure(a, BandPower::natural(), every_pose(3)).error_to_bake));
    a.decoded.setZero();
    const TransferError error = measure(a, BandPower::natural(), every_pose(3));
    EXPECT_EQ(error.error_to_bake, 0.0);
    EXPECT_EQ(error.total(), 0.0);
}

TEST(TransferError, DoesNotDependOnThreads) {
    // More blocks of rows than one, and a last one that is not full.
    const Animation a = random_animation({TransferKind::diffuse, 2, 1}, 2001, 6);
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        return measure(a, BandPower::natural(), mean_only(6));
    };
    const TransferError one = run(1), many = run(4);
    EXPECT_EQ(one.error_to_bake, many.error_to_bake);
    EXPECT_EQ(one.error, many.error);
    EXPECT_EQ(one.total(), many.total());
    EXPECT_EQ(one.worst_vertex_error_to_bake, many.worst_vertex_error_to_bake);
    EXPECT_EQ(one.worst_pose_error_to_bake, many.worst_pose_error_to_bake);
}

TEST(TransferErrorDeathTest, RefusesWhatMakesNoSense) {
    const Animation a = random_animation({TransferKind::diffuse, 1, 1}, 4, 3);
    const BandPower flat = BandPower::flat(1);
    const auto surveyed = [&] {
        TransferErrorMeter meter = new_meter(a, flat, every_pose(3));
        meter.survey(0, a.baked, a.noise);
        return meter;
    };
    const auto twice = [&] {
        TransferErrorMeter meter = surveyed();
        for (int n = 0; n < 2; ++n) meter.add(0, a.baked, a.noise, a.decoded);
    };
    EXPECT_DEATH(twice(), "added_");
    EXPECT_DEATH(new_meter(a, flat, every_pose(3)).result(), "added_");
    EXPECT_DEATH(surveyed().add(0, a.baked, a.noise, a.decoded.topRows(3)), "got 3 and 4");
    EXPECT_DEATH(surveyed().add(1, a.baked, a.noise, a.decoded), "got 1 and 1");
    EXPECT_DEATH(new_meter(a, flat, every_pose(3)).add(0, a.baked, a.noise, a.decoded),
                 "is_surveyed_");
    EXPECT_DEATH(surveyed().survey(1, a.baked, a.noise), "got 1 and 1");
    EXPECT_DEATH(new_meter(a, flat, MatrixXd::Identity(3, 3)), "constant");
    EXPECT_DEATH(new_meter(a, flat, 2.0 * every_pose(3)), "check failed");
    EXPECT_DEATH(new_meter(a, flat, every_pose(4)), "got 4 and 3");
}

}  // namespace
}  // namespace paim
