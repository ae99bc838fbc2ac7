// The whole decomposition on hard matrices, against long double: singular values, both sets of
// vectors, and that they give the matrix back.
#include <gtest/gtest.h>

#include "analysis/study/svd/hard_matrices.h"
#include "analysis/study/svd/reference_svd.h"
#include "compressor/encode/svd/left_singular_vectors.h"
#include "compressor/encode/svd/projected_blocks.h"
#include "paim/metrics/singular_value_error.h"

namespace paim {

// GoogleTest shows the name, not the bytes.
void PrintTo(const HardMatrix& hard, std::ostream* out) {
    *out << hard.name;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

// What the encoder computes before it rounds to float.
struct Decomposition {
    PrincipalComponents components;
    uint32_t rank;
    bool corrected;
    MatrixXd u;  // [rows][rank], unit length

    explicit Decomposition(const MatrixXf& matrix)
        : components(principal_components(MatrixRows(matrix))), rank(components.rank()) {
        const LeftVectors left(MatrixRows(matrix), components, rank);
        corrected = left.corrected();
        u.resize(matrix.rows(), static_cast<Index>(rank));
        const double length = std::sqrt(static_cast<double>(matrix.rows()));
        left.project(matrix, [&](Index first, const VectorXd&, const MatrixXd& factors) {
            u.middleRows(first, factors.rows()) = factors / length;
        });
    }
};

double off_orthonormal(const MatrixXd& columns) {
    if (columns.cols() == 0) return 0.0;
    const auto identity = MatrixXd::Identity(columns.cols(), columns.cols());
    return (columns.transpose() * columns - identity).cwiseAbs().maxCoeff();
}

class HardMatrices : public testing::TestWithParam<HardMatrix> {};

TEST_P(HardMatrices, SingularValuesAreThoseOfLongDouble) {
    const MatrixXf& matrix = GetParam().matrix;
    const PrincipalComponents components = principal_components(MatrixRows(matrix));
    const std::vector<double> exact = singular_values_reference(centred_reference(matrix));
    ASSERT_EQ(components.singular_values.size(), exact.size());
    // Householder's and Jacobi's rotations are backward stable: each value is off by a few
    // √P · 2^-53 s_0.
    const double tolerance =
        1e-13 * (exact.empty() ? 0.0 : exact[0]) * std::sqrt(static_cast<double>(matrix.cols()));
    for (size_t k = 0; k < exact.size(); ++k) {
        EXPECT_NEAR(components.singular_values[k], exact[k], tolerance) << k;
    }
    EXPECT_EQ(components.rank(), GetParam().rank);
}

TEST_P(HardMatrices, BothSetsOfVectorsAreOrthonormal) {
    const Decomposition d(GetParam().matrix);
    // U after its correction: 2^-53 times the condition of A' V S⁻¹, which is near 1, times √P;
    // without, what LeftVectors lets pass. V: Jacobi's own tolerance √P · 2^-52.
    EXPECT_LT(off_orthonormal(d.u), 1e-12);
    EXPECT_LT(off_orthonormal(d.components.v.leftCols(d.rank)), 1e-12);
}

TEST_P(HardMatrices, StoredComponentsAreOrthonormalToTheirRounding) {
    const MatrixXf& matrix = GetParam().matrix;
    const MatrixRows rows(matrix);
    const PrincipalComponents components = principal_components(rows);
    const uint32_t rank = components.rank();
    MatrixXd u(matrix.rows(), static_cast<Index>(rank));
    Index first = 0;
    for_each_encoded_block(rows, components, rank, [&](const EncodedRows& block) {
        const auto size = static_cast<Index>(block.mean.size());
        for (Index k = 0; k < u.cols(); ++k) {
            const auto& stored = block.components[static_cast<size_t>(k)];
            u.col(k).middleRows(first, size) =
                Eigen::Map<const Eigen::VectorXf>(stored.data(), size).cast<double>();
        }
        first += size;
    });
    u /= std::sqrt(static_cast<double>(matrix.rows()));
    // Each entry is off by 2^-24 of itself, so each product of unit columns by twice that at most.
    EXPECT_LT(off_orthonormal(u), 0x1p-23 + 0x1p-30);
}

TEST_P(HardMatrices, ProductIsTheMatrix) {
    const Decomposition d(GetParam().matrix);
    const MatrixXd centred = centred_reference(GetParam().matrix).cast<double>();
    const auto& s = d.components.singular_values;
    const MatrixXd product = d.u * Eigen::Map<const VectorXd>(s.data(), d.rank).asDiagonal() *
                             d.components.v.leftCols(d.rank).transpose();
    // What is dropped is below the floor of rank(), 1e-14 s_0 here; the rest is a few roundings of
    // s_0.
    EXPECT_LE((product - centred).cwiseAbs().maxCoeff(), 1e-13 * s[0]);
}

TEST_P(HardMatrices, ErrorsOfTheSpectrumAreFractions) {
    const PrincipalComponents components = principal_components(MatrixRows(GetParam().matrix));
    for (uint32_t k = 0; k <= components.rank(); ++k) {
        for (const double error : {theory_error(components.singular_values, k),
                                   energy_error(components.singular_values, k)}) {
            EXPECT_GE(error, 0.0) << k;  // fails for NaN
            EXPECT_LE(error, 1.0) << k;
        }
    }
    if (components.rank() == 0) {
        EXPECT_EQ(theory_error(components.singular_values, 0), 0.0);
        EXPECT_EQ(energy_error(components.singular_values, 0), 0.0);
    }
}

INSTANTIATE_TEST_SUITE_P(Cases, HardMatrices, testing::ValuesIn(hard_matrices()),
                         [](const auto& tested) {
                             std::string name = tested.param.name;
                             for (char& c : name)
                                 c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                             return name;
                         });

TEST(HardMatrix, GradedWalshHasItsClosedForm) {
    constexpr Index kRowsOfEach = 40;
    const MatrixXf matrix = hard::graded_walsh(kRowsOfEach);
    const Decomposition d(matrix);
    ASSERT_EQ(d.rank, 15u);
    for (Index k = 0; k < 15; ++k) {
        const double exact =
            4.0 * matrix.col(0).middleRows(k * kRowsOfEach, kRowsOfEach).cast<double>().norm();
        // Every column of A' holds every decade to full precision, and Householder's reflections
        // round relative to columns: 2^-52 s_0 times a few, which is 1 % of the smallest.
        EXPECT_NEAR(d.components.singular_values[static_cast<size_t>(k)], exact,
                    1e-15 * d.components.singular_values[0])
            << k;
    }
    EXPECT_TRUE(d.corrected);
    // Uncorrected, the last columns of A' V S⁻¹ lean on the first by 2^-53 s_0/s_k.
    const MatrixXd centred = centred_reference(matrix).cast<double>();
    const MatrixXd plain = centred * d.components.v.leftCols(15) *
                           Eigen::Map<const VectorXd>(d.components.singular_values.data(), 15)
                               .cwiseInverse()
                               .asDiagonal();
    EXPECT_GT(off_orthonormal(plain), 1e-4);
}

TEST(HardMatrix, GramMatrixWouldLoseTheTail) {
    // What docs/results/svd.md says: below 1e-8 s_0 its values are noise.
    const MatrixXf matrix = hard::graded_walsh(40);
    const MatrixXd centred = centred_reference(matrix).cast<double>();
    const MatrixXd gram = centred.transpose() * centred;
    const std::vector<double> squared = singular_values_reference(gram.cast<long double>());
    const std::vector<double> exact = singular_values_reference(centred_reference(matrix));
    EXPECT_GT(std::abs(std::sqrt(squared[14]) / exact[14] - 1.0), 10.0);
}

TEST(HardMatrix, ComponentsOfComparableSizeNeedNoThirdPass) {
    EXPECT_FALSE(Decomposition(hard::random(2000, 20)).corrected);
}

TEST(HardMatrix, RankIsExactForFewPosesOfManyRows) {
    // The roundings of many folds: 6.6 · 2^-52 of the largest value, more than the number of poses.
    const MatrixXf matrix = hard::repeated_poses(1000000, 3, 2);
    EXPECT_EQ(principal_components(MatrixRows(matrix)).rank(), 2u);
}

}  // namespace
}  // namespace paim
