// Quantised clusters against the factors, vertex by vertex.
#include "compressor/encode/search/cpca/clustered_quantise.h"

#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "tests/unit/encode/quantise/random_factors.h"

namespace paim {
namespace {

using Eigen::Index;

const std::vector<double> kWeights{1.0, 4.0, 0.25, 0.01};

// Points near a few subspaces, so that clusters matter, and some noise that they leave.
ScaledFactors clustered_factors(uint32_t num_points = 600) {
    ScaledFactors factors = random_factors({num_points, 4, 12, {1.0, 0.5, 0.25}});
    RandomStream random(17);
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    const size_t num_values = 4 * (1 + factors.components.size());
    std::vector<float> centre(5 * num_values), direction(5 * num_values);
    for (float& x : centre) x = 2.0f * number();
    for (float& x : direction) x = number();
    for (uint32_t n = 0; n < num_points; ++n) {
        const size_t own = n % 5 * num_values;
        const float at = number();
        for (uint32_t j = 0; j < 4; ++j) {
            const size_t row = size_t{j} * num_points + n;
            const auto value = [&](size_t column) {
                const size_t i = own + column * 4 + j;
                return centre[i] + at * direction[i] + 0.05f * number();
            };
            factors.mean[row] = value(0);
            for (size_t k = 0; k < factors.components.size(); ++k) {
                factors.components[k][row] = value(1 + k);
            }
        }
    }
    return factors;
}

class ClusterTransfer : public testing::Test {
  protected:
    void cluster(const ScaledFactors& factors, uint32_t num_clusters) {
        ClusteringOptions options;
        options.num_clusters = num_clusters;
        options.assumed_components = 2;
        options.max_components = 6;
        pca_ = clustered_pca(FactorPoints(factors, kWeights), options);
    }

    double decoded(const ScaledFactors& factors, const ClusteredFactors& clustered,
                   const Quantiser& quantiser) const {
        ClusteredMatrix quantised = quantise_clusters(clustered, quantiser);
        const CodedMesh mesh =
            mesh_of(CpcaTransfer(std::move(quantised.matrix), std::move(quantised.clusters)),
                    factors.num_points);
        return decoded_error(mesh, factors, kWeights);
    }

    ClusteredPca pca_;
};

TEST_F(ClusterTransfer, PointsAreWeightedFactors) {
    const ScaledFactors factors = clustered_factors();
    const FactorPoints points(factors, kWeights);
    ASSERT_EQ(points.num_columns(), 4u);
    Eigen::MatrixXf plane(600, 4);
    points.read(1, plane);
    EXPECT_EQ(plane(17, 0), 2.0f * factors.mean[617]);
    EXPECT_EQ(plane(17, 3), 2.0f * factors.components[2][617]);
}

// Bases that are not quantised leave what clusters and components leave, and no more.
TEST_F(ClusterTransfer, BasesLeaveWhatIsTruncated) {
    const ScaledFactors factors = clustered_factors();
    cluster(factors, 7);
    for (const uint32_t count : {0u, 1u, 3u, 6u}) {
        const ClusteredFactors clustered = cluster_bases(factors, kWeights, pca_, count);
        ASSERT_EQ(clustered.bases.num_points, pca_.num_clusters * (count + 1));
        double error = 0.0;
        for (uint32_t j = 0; j < 4; ++j) {
            const Eigen::MatrixXd rows = exact_plane(clustered.bases, j);
            const Eigen::MatrixXd exact = exact_plane(factors, j);
            for (uint32_t v = 0; v < 600; ++v) {
                const uint32_t c = pca_.cluster[v];
                const Index first = Index{c} * (count + 1);
                Eigen::RowVectorXd row = rows.row(first);
                for (Index k = 0; k < count; ++k) {
                    row += double{pca_.coefficients(v, k)} * rows.row(first + 1 + k);
                }
                row /= std::sqrt(pca_.size[c]);
                error += kWeights[j] * (row - exact.row(v)).squaredNorm();
            }
        }
        // Floats: 2^-24 of values near 1, and of sums that cancel.
        EXPECT_NEAR(error / clustered.truncated, 1.0, 1e-4) << count;
    }
}

TEST_F(ClusterTransfer, ErrorIsThatOfWhatIsDecoded) {
    const ScaledFactors factors = clustered_factors();
    cluster(factors, 7);
    const ClusteredFactors clustered = cluster_bases(factors, kWeights, pca_, 3);
    for (const double step : {0.5, 0.1, 0.01}) {
        const Quantiser quantiser{step, 3, kWeights};
        const double stated = clustered_error(clustered, quantiser);
        // Errors of bases and of coefficients are added as if they had nothing to do with each
        // other. Weights are rounded, too: 3 · 12 of them, each as bad as a value of the bases on
        // average; the bases have 4 · 4 · 28 values, and there are 1800 coefficients.
        EXPECT_NEAR(decoded(factors, clustered, quantiser) / stated, 1.0, 0.1) << step;
    }
}

// Steps of coefficients are those of the bases' own errors: neither part has nearly all of it.
TEST_F(ClusterTransfer, CoefficientsCostAsMuchAValueAsBases) {
    const ScaledFactors factors = clustered_factors();
    cluster(factors, 7);
    const ClusteredFactors clustered = cluster_bases(factors, kWeights, pca_, 3);
    const Quantiser quantiser{0.01, 3, kWeights};
    const double bases = quantised_error(clustered.bases, quantiser);
    const double coefficients = clustered_error(clustered, quantiser) - bases - clustered.truncated;
    // 1800 coefficients and 28 rows of 4 planes and 4 columns, less what weights can mend; each
    // part has a deviation of some √(0.8 / 448), 4 %.
    EXPECT_NEAR(coefficients / 1800.0 / (bases / 448.0), 1.0, 0.25);
}

TEST_F(ClusterTransfer, LargestStepIsTheLargest) {
    const ScaledFactors factors = clustered_factors();
    cluster(factors, 7);
    const ClusteredFactors clustered = cluster_bases(factors, kWeights, pca_, 3);
    Quantiser quantiser{1.0, 3, kWeights};
    EXPECT_EQ(largest_step(clustered, quantiser, 0.999 * clustered.truncated), 0.0);
    const double most = 1.5 * clustered.truncated;
    quantiser.step = largest_step(clustered, quantiser, most);
    EXPECT_LE(clustered_error(clustered, quantiser), most);
    quantiser.step *= 1.03;
    EXPECT_GT(clustered_error(clustered, quantiser), most);
}

// One vertex in which all of a cluster's component is: its coefficient is the root of the size.
TEST_F(ClusterTransfer, SmallestStepFitsCoefficientsToo) {
    ScaledFactors factors = random_factors({900, 4, 12, {1.0, 0.5, 0.25}});
    for (auto* values :
         {&factors.mean, &factors.components[0], &factors.components[1], &factors.components[2]}) {
        for (size_t r = 0; r < values->size(); ++r) {
            if (r % 900 != 123) (*values)[r] = 0.0f;
            if (r % 900 == 123) (*values)[r] = 1.0f;
        }
    }
    cluster(factors, 1);
    const ClusteredFactors clustered = cluster_bases(factors, kWeights, pca_, 1);
    Quantiser quantiser{1.0, 3, kWeights};
    const double of_bases = smallest_step(clustered.bases, quantiser, Precision::i16);
    quantiser.step = smallest_step(clustered, quantiser);
    EXPECT_GT(quantiser.step, 1.5 * of_bases);
    EXPECT_NO_THROW(quantise_clusters(clustered, quantiser));
    quantiser.step *= 0.999;
    EXPECT_THROW(quantise_clusters(clustered, quantiser), Error);
}

TEST_F(ClusterTransfer, TakesMoreClustersThanPointsAndNothing) {
    ScaledFactors factors = random_factors({3, 4, 12, {1.0, 0.5, 0.25}});
    cluster(factors, 32);
    ClusteredFactors clustered = cluster_bases(factors, kWeights, pca_, 6);
    const Quantiser quantiser{0.001, 3, kWeights};
    EXPECT_NEAR(decoded(factors, clustered, quantiser) / clustered_error(clustered, quantiser), 1.0,
                0.5);
    for (auto& component : factors.components) std::fill(component.begin(), component.end(), 0.0f);
    std::fill(factors.mean.begin(), factors.mean.end(), 0.0f);
    cluster(factors, 2);
    clustered = cluster_bases(factors, kWeights, pca_, 2);
    EXPECT_EQ(largest_step(clustered, quantiser, 0.0), 1.0);
    EXPECT_EQ(decoded(factors, clustered, quantiser), 0.0);
}

}  // namespace
}  // namespace paim
