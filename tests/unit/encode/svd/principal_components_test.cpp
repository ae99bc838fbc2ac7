// Streamed principal components against a dense decomposition of the same matrix.
#include "compressor/encode/svd/principal_components.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>

#include "compressor/encode/svd/left_singular_vectors.h"
#include "compressor/encode/svd/projected_blocks.h"
#include "compressor/encode/svd/tsqr.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "tests/reference_svd.h"

namespace paim {
namespace {

using Eigen::MatrixXd;
using Eigen::MatrixXf;

MatrixXf random_matrix(int rows, int columns) {
    std::srand(11);
    return MatrixXf::Random(rows, columns);
}

MatrixXd centred(const MatrixXf& matrix) {
    MatrixXd result = matrix.cast<double>();
    result.colwise() -= MatrixXd(result.rowwise().mean()).col(0);
    return result;
}

// mean + components · weights, from the streamed blocks.
MatrixXd rebuild(const MatrixXf& matrix, const PrincipalComponents& components, uint32_t count) {
    const MatrixRows rows(matrix);
    const std::vector<float> weights = component_weights(components, count, rows.num_rows());
    MatrixXd result(matrix.rows(), matrix.cols());
    Eigen::Index first = 0;
    for_each_encoded_block(rows, components, count, [&](const EncodedRows& block) {
        for (size_t r = 0; r < block.mean.size(); ++r, ++first) {
            for (Eigen::Index p = 0; p < matrix.cols(); ++p) {
                double value = block.mean[r];
                for (uint32_t k = 0; k < count; ++k) {
                    value +=
                        static_cast<double>(block.components[k][r]) *
                        weights[k * static_cast<size_t>(matrix.cols()) + static_cast<size_t>(p)];
                }
                result(first, p) = value;
            }
        }
    });
    EXPECT_EQ(first, matrix.rows());
    return result;
}

TEST(CentredTriangularFactor, HasTheGramMatrixOfTheCentredRows) {
    for (const int rows : {3, 12, 5000, 9001}) {
        const MatrixXf matrix = random_matrix(rows, 12);
        const MatrixXd r = centred_triangular_factor(MatrixRows(matrix));
        const MatrixXd c = centred(matrix);
        EXPECT_LT((r.transpose() * r - c.transpose() * c).norm(), 1e-12 * c.squaredNorm()) << rows;
        EXPECT_EQ(r.triangularView<Eigen::StrictlyLower>().toDenseMatrix().norm(), 0.0);
    }
}

TEST(PrincipalComponents, SingularValuesAgreeWithEigen) {
    for (const auto& [rows, columns] : {std::pair{6000, 20}, {7, 20}, {20, 20}, {50, 1}, {50, 2}}) {
        const MatrixXf matrix = random_matrix(rows, columns);
        const PrincipalComponents components = principal_components(MatrixRows(matrix));
        const Eigen::VectorXd reference = reference_svd(centred(matrix)).singular_values;
        ASSERT_EQ(components.singular_values.size(), static_cast<size_t>(reference.size()));
        for (Eigen::Index k = 0; k < reference.size(); ++k) {
            EXPECT_NEAR(components.singular_values[static_cast<size_t>(k)], reference[k],
                        1e-13 * std::max(reference[0], 1e-3) * columns);
        }
    }
}

TEST(PrincipalComponents, CentringTakesOneWhateverTheOffset) {
    // Far from the origin, the singular value that is zero comes out as rounding of the offset.
    for (const float offset : {0.0f, 10.0f, 1000.0f, 1e5f}) {
        MatrixXf matrix = random_matrix(9000, 7);  // the mean of seven rounds
        matrix.array() += offset;
        EXPECT_EQ(principal_components(MatrixRows(matrix)).rank(), 6u) << offset;
    }
    EXPECT_EQ(principal_components(MatrixRows(random_matrix(50, 1))).rank(), 0u);
}

TEST(PrincipalComponents, AllComponentsGiveTheDataBackToFloatRounding) {
    const MatrixXf matrix = random_matrix(5000, 20);
    const PrincipalComponents components = principal_components(MatrixRows(matrix));
    EXPECT_EQ(components.rank(), 19u);  // centring takes one
    const MatrixXd rebuilt = rebuild(matrix, components, components.rank());
    // Mean, 19 components and their weights are each rounded to 2^-24 relative.
    EXPECT_LT((rebuilt - matrix.cast<double>()).cwiseAbs().maxCoeff(), 20 * 0x1p-24 * 4);
}

TEST(PrincipalComponents, TruncationCostsWhatItsSingularValuesSay) {
    const MatrixXf matrix = random_matrix(5000, 20);
    const PrincipalComponents components = principal_components(MatrixRows(matrix));
    double all = 0.0, dropped = 0.0;
    for (size_t k = 0; k < 20; ++k) {
        const double energy = components.singular_values[k] * components.singular_values[k];
        all += energy;
        if (k >= 7) dropped += energy;
    }
    const double expected = std::sqrt(dropped / all);
    const double measured =
        (rebuild(matrix, components, 7) - matrix.cast<double>()).norm() / centred(matrix).norm();
    EXPECT_NEAR(measured / expected, 1.0, 1e-6);
}

TEST(PrincipalComponents, StillAnimationsHaveRankZero) {
    MatrixXf matrix(3000, 7);
    matrix.colwise() = random_matrix(3000, 1).col(0);
    const PrincipalComponents components = principal_components(MatrixRows(matrix));
    EXPECT_EQ(components.rank(), 0u);
    EXPECT_EQ(components.singular_values[0], 0.0);
    EXPECT_EQ(rebuild(matrix, components, 0), matrix.cast<double>());
}

TEST(PrincipalComponents, AreTheSameOnAnyNumberOfThreads) {
    const MatrixXf matrix = random_matrix(20000, 9);
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        const PrincipalComponents components = principal_components(MatrixRows(matrix));
        std::vector<float> values = component_weights(components, 8, 20000);
        for_each_encoded_block(MatrixRows(matrix), components, 8, [&](const EncodedRows& block) {
            values.insert(values.end(), block.components[5].begin(), block.components[5].end());
        });
        return values;
    };
    EXPECT_EQ(run(1), run(2));
}

// Rows that are computed where they are asked for.
class EndlessRows : public RowSource {
  public:
    EndlessRows(uint64_t num_rows, uint32_t num_columns)
        : num_rows_(num_rows), num_columns_(num_columns) {}
    uint64_t num_rows() const override { return num_rows_; }
    uint32_t num_columns() const override { return num_columns_; }
    void read(uint64_t first, MatrixXf& block) const override {
        for (Eigen::Index p = 0; p < block.cols(); ++p) {
            for (Eigen::Index row = 0; row < block.rows(); ++row) {
                const uint64_t bits =
                    stream_key(first + static_cast<uint64_t>(row), 0, static_cast<uint64_t>(p));
                // Columns fall off, so that the third pass is needed, too.
                block(row, p) =
                    std::ldexp(static_cast<float>(bits >> 40), -12 * static_cast<int>(p));
            }
        }
    }

  private:
    uint64_t num_rows_;
    uint32_t num_columns_;
};

TEST(PrincipalComponents, AreTheSameForAnyNumberInFlight) {
    constexpr uint32_t kColumns = 4;
    const uint64_t block = rows_per_block(kColumns);
    // Trees of 32 runs, of one less, of an odd number, of one; the last block is not full.
    for (const uint64_t num_blocks : {33, 31, 5, 1}) {
        const EndlessRows rows(num_blocks * block - 100, kColumns);
        const auto run = [&](uint32_t num_in_flight) {
            const PrincipalComponents components = principal_components(rows, num_in_flight);
            EXPECT_EQ(components.rank(), 3u);
            EXPECT_TRUE(LeftVectors(rows, components, 3, 0x1p-30, num_in_flight).corrected());
            std::vector<double> values = components.singular_values;
            values.insert(values.end(), components.v.data(),
                          components.v.data() + components.v.size());
            for_each_encoded_block(
                rows, components, 3,
                [&](const EncodedRows& encoded) {
                    for (const auto& component : encoded.components) {
                        values.push_back(component.front());
                        values.push_back(component.back());
                    }
                },
                num_in_flight);
            return values;
        };
        const std::vector<double> all = run(kMaxInFlight);
        for (const uint32_t fewer : {1, 2, 16}) EXPECT_EQ(run(fewer), all) << num_blocks;
    }
}

}  // namespace
}  // namespace paim
