// ScaledFactors of a known matrix in another order of vertices, thinned, and stored as floats.
#include "compressor/encode/quantise/scaled_factors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "compressor/encode/quantise/float_matrix.h"
#include "compressor/encode/search/part_search.h"
#include "paim/base/half.h"
#include "tests/unit/encode/quantise/random_factors.h"

namespace paim {
namespace {

using Eigen::Index;

constexpr uint32_t kVertices = 101;
constexpr uint32_t kPlanes = 3;
constexpr uint32_t kPoses = 9;

Eigen::MatrixXf random_rows() {
    RandomStream random(11);
    Eigen::MatrixXf rows(Index{kVertices * kPlanes}, Index{kPoses});
    for (float& x : rows.reshaped()) x = static_cast<float>(2.0 * random.uniform() - 1.0);
    return rows;
}

// 37 and 101 have no common factor.
std::vector<uint32_t> shuffled() {
    std::vector<uint32_t> old_vertex(kVertices);
    for (uint32_t v = 0; v < kVertices; ++v) old_vertex[v] = (37 * v + 5) % kVertices;
    return old_vertex;
}

TEST(ScaledFactors, AreTheMatrixInAnotherOrder) {
    const Eigen::MatrixXf matrix = random_rows();
    const MatrixRows rows(matrix);
    const PrincipalComponents pca = principal_components(rows);
    ASSERT_EQ(pca.rank(), kPoses - 1);
    const auto old_vertex = shuffled();
    const ScaledFactors factors = read_factors(rows, pca, pca.rank(), nullptr, old_vertex, 1);
    ASSERT_EQ(factors.num_points, kVertices);
    ASSERT_EQ(factors.num_planes, kPlanes);
    for (uint32_t j = 0; j < kPlanes; ++j) {
        const Eigen::MatrixXd plane = exact_plane(factors, j);
        for (uint32_t v = 0; v < kVertices; ++v) {
            const Eigen::RowVectorXd expected =
                matrix.row(Index{j * kVertices + old_vertex[v]}).cast<double>();
            // Nine floats near 1, each rounded by 2^-24 of itself.
            EXPECT_LT((plane.row(v) - expected).cwiseAbs().maxCoeff(), 1e-6) << j << " " << v;
        }
    }
}

TEST(ScaledFactors, HaveOrthogonalWeightsOfUnitRms) {
    const Eigen::MatrixXf matrix = random_rows();
    const MatrixRows rows(matrix);
    const PrincipalComponents pca = principal_components(rows);
    const ScaledFactors factors = read_factors(rows, pca, 5, nullptr, shuffled(), 4);
    ASSERT_EQ(factors.num_components(), 5u);
    ASSERT_EQ(factors.weights.rows(), 5);
    const Eigen::MatrixXd gram = factors.weights * factors.weights.transpose() / kPoses;
    EXPECT_LT((gram - Eigen::MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(factors.weights.rowwise().sum().cwiseAbs().maxCoeff(), 1e-12);
    // Components then carry the singular values: Σ c² P = s².
    for (uint32_t k = 0; k < 5; ++k) {
        double sum = 0.0;
        for (const float c : factors.components[k]) sum += double{c} * double{c};
        EXPECT_NEAR(sum * kPoses / std::pow(pca.singular_values[k], 2.0), 1.0, 1e-6);
    }
}

TEST(ScaledFactors, SampleKeepsOneOfEveryNPoints) {
    const ScaledFactors factors = random_factors({100, 4, 12, {1.0}});
    const ScaledFactors few = sample(factors, 240);  // of 800 values: every third
    ASSERT_EQ(few.num_points, 34u);
    ASSERT_EQ(few.mean.size(), 4u * 34);
    std::set<uint32_t> places;
    for (uint32_t n = 0; n < 34; ++n) {
        uint32_t at = 3 * n;
        while (at < 100 && factors.mean[at] != few.mean[n]) ++at;
        ASSERT_LT(at, 3 * n + 3);
        places.insert(at - 3 * n);
        for (uint32_t j = 0; j < 4; ++j) {
            EXPECT_EQ(few.mean[j * 34 + n], factors.mean[j * 100 + at]);
            EXPECT_EQ(few.components[0][j * 34 + n], factors.components[0][j * 100 + at]);
        }
    }
    EXPECT_EQ(places.size(), 3u);  // not always the same place, which bases repeat at
    EXPECT_EQ(sample(factors, 1'000'000).mean, factors.mean);
    EXPECT_EQ(sample(factors, 0).num_points, 1u);
}

TEST(ScaledFactors, TailErrorsAreWhatDroppedComponentsLeave) {
    const ScaledFactors factors = random_factors();
    const std::vector<double> weight{1.0, 4.0, 0.25, 0.01};
    const std::vector<double> tails = tail_errors(factors, weight);
    ASSERT_EQ(tails.size(), 4u);
    for (uint32_t k = 0; k <= 3; ++k) {
        const CodedMesh mesh =
            mesh_of(SvdTransfer(float_matrix(factors, k, Precision::f32)), factors.num_points);
        // Floats: 2^-24 of values near 1, 19200 of them.
        EXPECT_NEAR(decoded_error(mesh, factors, weight), tails[k], 1e-6 * tails[0] + 1e-9) << k;
    }
}

TEST(FloatMatrix, HasComponentsOfUnitRms) {
    ScaledFactors factors = random_factors();
    std::fill(factors.components[2].begin(), factors.components[2].end(), 0.0f);
    const LowRank matrix = float_matrix(factors, 1000, Precision::f32);
    EXPECT_EQ(matrix.num_components, 3u);
    EXPECT_EQ(matrix.mean.floats(), factors.mean);
    for (uint32_t k = 0; k < 2; ++k) {
        double sum = 0.0;
        for (const float c : matrix.components[k].floats()) sum += double{c} * double{c};
        EXPECT_NEAR(sum / static_cast<double>(matrix.num_rows()), 1.0, 1e-6);
    }
}

TEST(FloatMatrix, RoundsToHalfFloats) {
    const ScaledFactors factors = random_factors();
    const LowRank matrix = float_matrix(factors, 3, Precision::f16);
    for (const StoredValues& component : matrix.components) {
        for (const float c : component.floats()) EXPECT_EQ(from_half(to_half(c)), c);
    }
    // Half floats of values up to √3 are off by 2^-11 of themselves at most, as components are: no
    // more than that of the energy without the mean, and at least a tenth (uniform rounding: about
    // 0.2).
    const CodedMesh mesh = mesh_of(SvdTransfer(matrix), factors.num_points);
    const std::vector<double> alike(4, 1.0);
    const double energy = tail_errors(factors, alike)[0];
    const double relative = std::sqrt(decoded_error(mesh, factors, alike) / energy);
    EXPECT_LT(relative, std::exp2(-11));
    EXPECT_GT(relative, 0.1 * std::exp2(-11));
}

}  // namespace
}  // namespace paim
