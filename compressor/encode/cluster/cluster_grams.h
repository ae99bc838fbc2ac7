// Principal components of clusters in full dimension, plane by plane.
// Based on: Sirovich, Turbulence and the Dynamics of Coherent Structures, 1987 (the method of
//           snapshots: from Gram matrices of the members)
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/encode/cluster/cluster_members.h"
#include "compressor/encode/cluster/top_eigenpairs.h"
#include "compressor/encode/data/point_source.h"

namespace paim {

struct ClusterComponents {
    Eigenpairs pairs;     // of X Xᵀ, X the members about their mean: left vectors, squared values
    double energy = 0.0;  // its trace
};

// Some members' rows of a plane, [members][n], about `mean` [n].
Eigen::MatrixXd member_rows(const Eigen::MatrixXf& plane, std::span<const uint32_t> members,
                            const Eigen::RowVectorXd& mean);
Eigen::RowVectorXd member_mean(const Eigen::MatrixXf& plane, std::span<const uint32_t> members);

// No Gram matrix is larger than this, whatever it saves: 34 MB.
constexpr uint32_t kMaxGramMembers = 2048;
// The most members of a cluster whose Gram matrix is cheaper than passes over its points.
uint32_t max_gram_members(uint64_t num_dimensions, uint64_t num_components);

// Members whose rows are gathered at once.
constexpr size_t kRowsGathered = 1024;

// Through their Gram matrices n_c x n_c, in double, in as many passes as keep those below
// gram_bytes (one cluster at least). Squaring the condition number is fine here: components below
// 10^-7 of a cluster's first are far below anything that is stored.
// projected  [d][V] where the iteration starts
// clusters   which of them; out [clusters of members], those written
void components_by_grams(const PointSource& points, const Eigen::MatrixXf& projected,
                         const ClusterMembers& members, std::span<const uint32_t> clusters,
                         uint32_t num_components, uint64_t gram_bytes, uint64_t seed,
                         std::vector<ClusterComponents>& out);

// Memory of components_by_grams() on one thread for a cluster of n_c members, in addition to the
// Gram matrices: its rows of a plane or where an iteration starts, its eigenvectors and a few rows of
// the plane's width.
uint64_t gram_scratch_bytes(uint64_t num_members, uint64_t num_columns, uint64_t num_dimensions,
                            uint64_t num_components);

// For clusters whose Gram matrices would be too large: subspace iteration in which each step is a
// pass over the planes, X (Xᵀ Q). It starts from the principal directions of the projected points,
// which three steps refine: the error against the optimum shrinks with (σ_L / σ_K)^12.
// projected [d][V]
void components_by_passes(const PointSource& points, const Eigen::MatrixXf& projected,
                          const ClusterMembers& members, std::span<const uint32_t> clusters,
                          uint32_t num_components, uint64_t seed,
                          std::vector<ClusterComponents>& out);

// Memory of components_by_passes() for all members of its clusters: Q, G Q and their temporaries;
// their start.
uint64_t passes_scratch_bytes(uint64_t num_members, uint64_t num_dimensions,
                              uint64_t num_components);

}  // namespace paim
