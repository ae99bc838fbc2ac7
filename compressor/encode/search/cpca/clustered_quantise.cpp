// Clustered PCA of an animation's transfer, quantised.
#include "compressor/encode/search/cpca/clustered_quantise.h"

#include <algorithm>
#include <cmath>

#include "compressor/encode/memory/search_limits.h"
#include "compressor/encode/quantise/largest_step.h"
#include "paim/base/error.h"

namespace paim {

using Eigen::Index;

namespace {

// What coefficients are multiples of, by cluster and component; 0 for rows of nothing.
double coefficient_step(const ClusteredFactors& clustered, Index cluster, Index component,
                        double step) {
    const double norm = clustered.norms(cluster, component);
    return norm > 0.0 ? step / norm : 0.0;
}

double rounded(double coefficient, double step) {
    return step > 0.0 ? std::nearbyint(coefficient / step) : 0.0;
}

// Weighted squared error of rounded coefficients, over all vertices and poses.
double coefficient_error(const ClusteredFactors& clustered, const Quantiser& quantiser) {
    const ClusteredPca& pca = *clustered.pca;
    double sum = 0.0;
    for (Index j = 0; j < clustered.norms.cols(); ++j) {
        for (size_t v = 0; v < pca.cluster.size(); ++v) {
            const auto c = static_cast<Index>(pca.cluster[v]);
            const double step = coefficient_step(clustered, c, j, quantiser.step);
            const auto exact = static_cast<double>(pca.coefficients(static_cast<Index>(v), j));
            const double error = (exact - step * rounded(exact, step)) * clustered.norms(c, j);
            sum += error * error;
        }
    }
    return clustered.bases.num_poses() * sum;
}

StoredValues fewest_bits(const std::vector<double>& integers) {
    double largest = 0.0;
    for (const double q : integers) largest = std::max(largest, std::abs(q));
    if (largest <= 127.0) return std::vector<int8_t>(integers.begin(), integers.end());
    if (!(largest <= 32767.0)) {
        throw_unsupported("coefficients of {} steps do not fit in 16 bits", largest);
    }
    return std::vector<int16_t>(integers.begin(), integers.end());
}

}  // namespace

void FactorPoints::read(uint32_t plane, Eigen::Ref<Eigen::MatrixXf> out) const {
    const auto weight = static_cast<float>(std::sqrt(plane_weight_[plane]));
    const auto column = [&](const std::vector<float>& values) {
        return Eigen::Map<const Eigen::VectorXf>(factors_.plane(values, plane).data(), out.rows());
    };
    out.col(0) = weight * column(factors_.mean);
    for (Index k = 0; k + 1 < out.cols(); ++k) {
        out.col(k + 1) = weight * column(factors_.components[static_cast<size_t>(k)]);
    }
}

ClusteredFactors cluster_bases(const ScaledFactors& factors,
                               const std::vector<double>& plane_weight, const ClusteredPca& pca,
                               uint32_t num_components) {
    const FactorPoints points(factors, plane_weight);
    const uint32_t stride = num_components + 1;
    const auto num_rows = static_cast<Index>(pca.num_clusters * stride);
    ClusteredFactors clustered;
    clustered.pca = &pca;
    clustered.num_components = num_components;
    clustered.norms = Eigen::MatrixXd::Zero(pca.num_clusters, num_components);
    clustered.truncated = factors.num_poses() * pca.squared_error(num_components);
    ScaledFactors& bases = clustered.bases;
    bases.num_points = static_cast<uint32_t>(num_rows);
    bases.num_planes = factors.num_planes;
    bases.weights = factors.weights;
    bases.singular_values = factors.singular_values;
    bases.components.resize(factors.components.size());

    Eigen::VectorXf root(num_rows);
    for (Index r = 0; r < num_rows; ++r) {
        root[r] = std::sqrt(static_cast<float>(pca.size[static_cast<size_t>(r / stride)]));
    }
    for_each_basis_plane(
        points, pca, num_components, [&](uint32_t plane, const Eigen::MatrixXf& rows) {
            for (Index r = 0; r < num_rows; ++r) {
                if (r % stride > 0) {
                    clustered.norms(r / stride, r % stride - 1) +=
                        rows.row(r).cast<double>().squaredNorm();
                }
            }
            const auto weight = static_cast<float>(std::sqrt(plane_weight[plane]));
            const auto append = [&](std::vector<float>& values, Index column) {
                const Eigen::VectorXf scaled = rows.col(column).cwiseProduct(root) / weight;
                values.insert(values.end(), scaled.begin(), scaled.end());
            };
            append(bases.mean, 0);
            for (size_t k = 0; k < bases.components.size(); ++k) {
                append(bases.components[k], static_cast<Index>(k) + 1);
            }
        });
    clustered.norms = clustered.norms.cwiseSqrt();
    return clustered;
}

ClusteredMatrix quantise_clusters(const ClusteredFactors& clustered, const Quantiser& quantiser) {
    const ClusteredPca& pca = *clustered.pca;
    ClusteredMatrix result;
    result.matrix = quantise(clustered.bases, quantiser);
    VertexClusters& clusters = result.clusters;
    clusters.num_clusters = pca.num_clusters;
    clusters.num_components = clustered.num_components;
    clusters.cluster = pca.cluster;
    for (uint32_t c = 0; c < pca.num_clusters; ++c) {
        const double shrink = 1.0 / std::sqrt(static_cast<double>(pca.size[c]));
        clusters.scales.push_back(static_cast<float>(shrink));
        for (Index j = 0; j < clustered.norms.cols(); ++j) {
            clusters.scales.push_back(static_cast<float>(
                shrink * coefficient_step(clustered, static_cast<Index>(c), j, quantiser.step)));
        }
    }
    std::vector<double> integers(pca.cluster.size());
    for (Index j = 0; j < clustered.norms.cols(); ++j) {
        for (size_t v = 0; v < integers.size(); ++v) {
            const auto c = static_cast<Index>(pca.cluster[v]);
            integers[v] = rounded(static_cast<double>(pca.coefficients(static_cast<Index>(v), j)),
                                  coefficient_step(clustered, c, j, quantiser.step));
        }
        clusters.coefficients.push_back(fewest_bits(integers));
    }
    return result;
}

double clustered_error(const ClusteredFactors& clustered, const Quantiser& quantiser) {
    return clustered.truncated + quantised_error(clustered.bases, quantiser) +
           coefficient_error(clustered, quantiser);
}

double smallest_step(const ClusteredFactors& clustered, const Quantiser& quantiser) {
    const ClusteredPca& pca = *clustered.pca;
    double largest = 0.0;  // coefficient, in steps of 1
    for (Index j = 0; j < clustered.norms.cols(); ++j) {
        for (size_t v = 0; v < pca.cluster.size(); ++v) {
            const auto coefficient =
                static_cast<double>(pca.coefficients(static_cast<Index>(v), j));
            const auto c = static_cast<Index>(pca.cluster[v]);
            largest = std::max(largest, std::abs(coefficient) * clustered.norms(c, j));
        }
    }
    // A little more, as the quotient is rounded.
    return std::max(smallest_step(clustered.bases, quantiser, Precision::i16),
                    1.0001 * largest / largest_integer(Precision::i16));
}

double largest_step(const ClusteredFactors& clustered, Quantiser quantiser, double most) {
    const ScaledFactors few = sample(clustered.bases, kSampledValues);
    const double sampled = static_cast<double>(few.num_points) / clustered.bases.num_points;
    const auto error = [&](double of_few) {
        return clustered.truncated + of_few / sampled + coefficient_error(clustered, quantiser);
    };
    return largest_step(
        smallest_step(clustered, quantiser), most,
        [&](double step) {
            quantiser.step = step;
            return error(rounding_error(few, quantiser));
        },
        [&](double step) {
            quantiser.step = step;
            return error(quantised_error(few, quantiser));
        });
}

}  // namespace paim
