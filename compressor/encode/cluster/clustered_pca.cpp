// Clustered principal component analysis.
// Based on: Sloan, Hall, Hart and Snyder 2003 (see the header)
#include "compressor/encode/cluster/clustered_pca.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compressor/encode/cluster/cluster_grams.h"
#include "compressor/encode/cluster/cluster_members.h"
#include "compressor/encode/cluster/clustered_pca_memory.h"
#include "compressor/encode/cluster/point_projection.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXf;

namespace {

// Writes a cluster's rows of the result. Signs: the largest coefficient of each component is
// positive, the first of equals.
void store(const ClusterComponents& components, std::span<const uint32_t> members, uint32_t c,
           ClusteredPca& pca) {
    const auto& [values, vectors] = components.pairs;
    const auto size = static_cast<double>(members.size());
    pca.energy[c] = components.energy;
    // The Gram matrix is rounded to some 2^-52 of its largest eigenvalue a row; below that there
    // is nothing.
    const double floor =
        values.size() == 0 ? 0.0 : 4.0 * size * std::numeric_limits<double>::epsilon() * values[0];
    for (Index k = 0; k < values.size() && values[k] > floor; ++k) {
        Index largest = 0;
        vectors.col(k).cwiseAbs().maxCoeff(&largest);
        const double scale = std::copysign(std::sqrt(size), vectors(largest, k));
        pca.singular_values(c, k) = std::sqrt(values[k]);
        for (size_t m = 0; m < members.size(); ++m) {
            pca.coefficients(members[m], k) =
                static_cast<float>(scale * vectors(static_cast<Index>(m), k));
        }
    }
}

}  // namespace

double ClusteredPca::squared_error(uint32_t count) const {
    PAIM_CHECK_LE(count, num_components);
    double sum = 0.0;
    for (uint32_t c = 0; c < num_clusters; ++c) {
        sum += std::max(0.0, energy[c] - singular_values.row(c).head(count).squaredNorm());
    }
    return sum;
}

ClusteredPca clustered_pca(const PointSource& points, const MatrixXf& projected,
                           const Clustering& clustering, const ClusteringOptions& options) {
    const ClusterMembers members(clustering.cluster, clustering.num_clusters);
    ClusteredPca pca;
    pca.num_clusters = clustering.num_clusters;
    pca.num_components = options.max_components;
    pca.cluster = clustering.cluster;
    pca.energy.resize(pca.num_clusters);
    pca.singular_values = Eigen::MatrixXd::Zero(pca.num_clusters, pca.num_components);
    pca.coefficients = MatrixXf::Zero(points.num_points(), pca.num_components);
    if (pca.num_clusters == 0) return pca;
    std::vector<uint32_t> small, large;
    const uint32_t most = max_gram_members(points.num_dimensions(), pca.num_components);
    for (uint32_t c = 0; c < pca.num_clusters; ++c) {
        pca.size.push_back(members.size(c));
        (members.size(c) <= most ? small : large).push_back(c);
    }
    std::vector<ClusterComponents> components(pca.num_clusters);
    components_by_grams(points, projected, members, small, pca.num_components,
                        spare_gram_bytes(points, options), options.seed, components);
    components_by_passes(points, projected, members, large, pca.num_components, options.seed,
                         components);
    parallel_for(pca.num_clusters, 1, [&](size_t c, size_t) {
        store(components[c], members.of(c), static_cast<uint32_t>(c), pca);
    });
    return pca;
}

ClusteredPca clustered_pca(const PointSource& points, const MatrixXf& projected,
                           const ClusteringOptions& options, const std::string& what) {
    PAIM_CHECK_EQ(static_cast<uint64_t>(projected.cols()), uint64_t{points.num_points()});
    check_memory(points, options, what);
    if (points.num_points() == 0) return clustered_pca(points, projected, Clustering(), options);
    return clustered_pca(points, projected, cluster_points(projected, options), options);
}

ClusteredPca clustered_pca(const PointSource& points, const ClusteringOptions& options,
                           const std::string& what) {
    check_memory(points, options, what);
    if (points.num_points() == 0) return clustered_pca(points, MatrixXf(), options, what);
    return clustered_pca(points, project_points(points, options.num_dimensions(), options.seed),
                         options, what);
}

void for_each_basis_plane(
    const PointSource& points, const ClusteredPca& pca, uint32_t num_components,
    const std::function<void(uint32_t plane, const MatrixXf& rows)>& on_plane) {
    PAIM_CHECK_LE(num_components, pca.num_components);
    PAIM_CHECK_EQ(pca.cluster.size(), points.num_points());
    const ClusterMembers members(pca.cluster, pca.num_clusters);
    const auto step = static_cast<Index>(num_components) + 1;
    MatrixXf plane(static_cast<Index>(points.num_points()),
                   static_cast<Index>(points.num_columns()));
    MatrixXf rows(static_cast<Index>(pca.num_clusters) * step, plane.cols());
    for (uint32_t j = 0; j < points.num_planes(); ++j) {
        points.read(j, plane);
        parallel_for(pca.num_clusters, 1, [&](size_t c, size_t) {
            const auto own = members.of(c);
            const Eigen::RowVectorXd mean = member_mean(plane, own);
            Eigen::MatrixXd sums =
                Eigen::MatrixXd::Zero(static_cast<Index>(num_components), plane.cols());
            for (size_t m = 0; m < own.size() && num_components > 0; m += kRowsGathered) {
                const auto some = own.subspan(m, std::min(kRowsGathered, own.size() - m));
                Eigen::MatrixXd weights(static_cast<Index>(some.size()), sums.rows());
                for (size_t i = 0; i < some.size(); ++i) {
                    weights.row(static_cast<Index>(i)) =
                        pca.coefficients.row(some[i]).head(sums.rows()).cast<double>();
                }
                sums.noalias() += weights.transpose() * member_rows(plane, some, mean);
            }
            const Index first = static_cast<Index>(c) * step;
            rows.row(first) = mean.cast<float>();
            rows.middleRows(first + 1, sums.rows()) =
                (sums / static_cast<double>(own.size())).cast<float>();
        });
        on_plane(j, rows);
    }
}

}  // namespace paim
