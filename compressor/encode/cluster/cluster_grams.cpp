// Principal components of clusters, from their Gram matrices or by streamed iteration.
// Based on: Sirovich 1987; Halko, Martinsson and Tropp 2011
#include "compressor/encode/cluster/cluster_grams.h"

#include <algorithm>
#include <utility>

#include "paim/base/parallel.h"
#include "paim/base/seed.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

// Of components_by_passes().
constexpr int kPasses = 3;

}  // namespace

uint32_t max_gram_members(uint64_t num_dimensions, uint64_t num_components) {
    // n members of d dimensions and L iterated directions: n² d for the Gram matrix and some three
    // steps of 2 n² L each, against 4 n d L a pass.
    const auto iterated = static_cast<uint64_t>(
        iterated_directions(static_cast<Index>(num_components), kMaxGramMembers));
    return static_cast<uint32_t>(std::min<uint64_t>(
        kMaxGramMembers,
        4 * kPasses * num_dimensions * iterated / (num_dimensions + 6 * iterated)));
}

Eigen::RowVectorXd member_mean(const MatrixXf& plane, std::span<const uint32_t> members) {
    Eigen::RowVectorXd mean(plane.cols());
    for (Index c = 0; c < plane.cols(); ++c) {
        double sum = 0.0;
        for (const uint32_t v : members) sum += static_cast<double>(plane(v, c));
        mean[c] = sum / static_cast<double>(members.size());
    }
    return mean;
}

MatrixXd member_rows(const MatrixXf& plane, std::span<const uint32_t> members,
                     const Eigen::RowVectorXd& mean) {
    MatrixXd rows(static_cast<Index>(members.size()), plane.cols());
    for (Index c = 0; c < plane.cols(); ++c) {
        for (Index m = 0; m < rows.rows(); ++m) {
            rows(m, c) = static_cast<double>(plane(members[static_cast<size_t>(m)], c)) - mean[c];
        }
    }
    return rows;
}

namespace {

// As many directions as are iterated for `wanted`: the left vectors of the projected members, the
// largest first, and random ones where that is more than dimensions.
MatrixXd projected_start(const MatrixXf& projected, std::span<const uint32_t> members, Index wanted,
                         uint64_t key) {
    const Index count = iterated_directions(wanted, static_cast<Index>(members.size()));
    MatrixXd rows(static_cast<Index>(members.size()), projected.rows());
    for (Index m = 0; m < rows.rows(); ++m) {
        rows.row(m) = projected.col(members[static_cast<size_t>(m)]).cast<double>().transpose();
    }
    const Index known = std::min(count, rows.cols());
    RandomStream random(key);
    MatrixXd start =
        MatrixXd::NullaryExpr(rows.rows(), count, [&] { return random.uniform() - 0.5; });
    // Points that are all zero are projected to no dimension, where there is nothing to solve for.
    if (known == 0) return orthonormal_basis(start);
    const Eigen::RowVectorXd mean = rows.colwise().mean();
    rows.rowwise() -= mean;
    const Eigenpairs all = all_eigenpairs(rows.transpose() * rows);
    start.leftCols(known) = rows * all.vectors.leftCols(known);
    return orthonormal_basis(start);
}

}  // namespace

void components_by_grams(const PointSource& points, const MatrixXf& projected,
                         const ClusterMembers& members, std::span<const uint32_t> clusters,
                         uint32_t num_components, uint64_t gram_bytes, uint64_t seed,
                         std::vector<ClusterComponents>& out) {
    MatrixXf plane(static_cast<Index>(points.num_points()),
                   static_cast<Index>(points.num_columns()));
    while (!clusters.empty()) {
        size_t count = 0;
        for (uint64_t bytes = 0; count < clusters.size(); ++count) {
            const uint64_t size = members.size(clusters[count]);
            bytes += size * size * sizeof(double);
            if (count > 0 && bytes > gram_bytes) break;
        }
        std::vector<MatrixXd> grams(count);
        for (size_t g = 0; g < count; ++g) {
            const auto size = static_cast<Index>(members.size(clusters[g]));
            grams[g] = MatrixXd::Zero(size, size);
        }
        for (uint32_t j = 0; j < points.num_planes(); ++j) {
            points.read(j, plane);
            parallel_for(count, 1, [&](size_t g, size_t) {
                const auto own = members.of(clusters[g]);
                const MatrixXd rows = member_rows(plane, own, member_mean(plane, own));
                grams[g].selfadjointView<Eigen::Lower>().rankUpdate(rows);
            });
        }
        parallel_for(count, 1, [&](size_t g, size_t) {
            MatrixXd& gram = grams[g];
            gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
            ClusterComponents& of = out[clusters[g]];
            of.energy = gram.trace();
            const auto wanted = static_cast<Index>(num_components);
            MatrixXd start;
            if (is_iterated(std::min(wanted, gram.rows()), gram.rows())) {
                start = projected_start(projected, members.of(clusters[g]), wanted,
                                        stream_key(seed, clusters[g], 2));
            }
            of.pairs = top_eigenpairs(gram, wanted, std::move(start));
            gram.resize(0, 0);
        });
        clusters = clusters.subspan(count);
    }
}

uint64_t gram_scratch_bytes(uint64_t num_members, uint64_t num_columns, uint64_t num_dimensions,
                            uint64_t num_components) {
    // Either rows of a plane, or the start of an iteration with its temporaries.
    const auto start = static_cast<uint64_t>(iterated_directions(static_cast<Index>(num_components),
                                                                 static_cast<Index>(num_members))) +
                       2 * num_dimensions;
    return (num_members * std::max(num_columns, start) + 3 * num_columns) * sizeof(double) +
           top_eigenpairs_scratch_bytes(num_members, num_components);
}

namespace {

// Calls body(first, rows) for the rows of a plane of a cluster's members, some at a time.
template <typename Body>
void for_member_rows(const MatrixXf& plane, std::span<const uint32_t> members,
                     const Eigen::RowVectorXd& mean, Body&& body) {
    for (size_t m = 0; m < members.size(); m += kRowsGathered) {
        body(static_cast<Index>(m),
             member_rows(plane, members.subspan(m, std::min(kRowsGathered, members.size() - m)),
                         mean));
    }
}

}  // namespace

uint64_t passes_scratch_bytes(uint64_t num_members, uint64_t num_dimensions,
                              uint64_t num_components) {
    const auto iterated = static_cast<uint64_t>(
        iterated_directions(static_cast<Index>(num_components), static_cast<Index>(num_members)));
    return num_members * (4 * iterated + 2 * num_dimensions) * sizeof(double);
}

void components_by_passes(const PointSource& points, const MatrixXf& projected,
                          const ClusterMembers& members, std::span<const uint32_t> clusters,
                          uint32_t num_components, uint64_t seed,
                          std::vector<ClusterComponents>& out) {
    if (clusters.empty()) return;
    const auto wanted = static_cast<Index>(num_components);
    MatrixXf plane(static_cast<Index>(points.num_points()),
                   static_cast<Index>(points.num_columns()));
    std::vector<MatrixXd> q(clusters.size()), gram_q(clusters.size());
    std::vector<double> energy(clusters.size());
    parallel_for(clusters.size(), 1, [&](size_t g, size_t) {
        const auto own = members.of(clusters[g]);
        q[g] = projected_start(projected, own, wanted, stream_key(seed, clusters[g], 2));
    });
    for (int pass = 0; pass < kPasses; ++pass) {
        for (size_t g = 0; g < clusters.size(); ++g) {
            if (pass > 0) q[g] = orthonormal_basis(gram_q[g]);
            gram_q[g] = MatrixXd::Zero(q[g].rows(), q[g].cols());
            energy[g] = 0.0;
        }
        for (uint32_t j = 0; j < points.num_planes(); ++j) {
            points.read(j, plane);
            parallel_for(clusters.size(), 1, [&](size_t g, size_t) {
                const auto own = members.of(clusters[g]);
                const Eigen::RowVectorXd mean = member_mean(plane, own);
                MatrixXd factors = MatrixXd::Zero(plane.cols(), q[g].cols());
                for_member_rows(plane, own, mean, [&](Index first, const MatrixXd& rows) {
                    energy[g] += rows.squaredNorm();
                    factors.noalias() += rows.transpose() * q[g].middleRows(first, rows.rows());
                });
                for_member_rows(plane, own, mean, [&](Index first, const MatrixXd& rows) {
                    gram_q[g].middleRows(first, rows.rows()).noalias() += rows * factors;
                });
            });
        }
    }
    parallel_for(clusters.size(), 1, [&](size_t g, size_t) {
        out[clusters[g]] = {ritz_pairs(q[g], gram_q[g], wanted), energy[g]};
    });
}

}  // namespace paim
