// Affine subspaces of clusters.
// Based on: Kambhatla and Leen 1997; subspace iteration as in Saad, Numerical Methods for Large
//           Eigenvalue Problems, 2011, chapter 5
#include "compressor/encode/cluster/cluster_subspaces.h"

#include <Eigen/QR>

#include <algorithm>

#include "compressor/encode/cluster/top_eigenpairs.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/base/seed.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXf;
using Eigen::VectorXf;

namespace {

constexpr size_t kMembersAtOnce = 1024;

// Members first … of a cluster, about its mean, a column each.
MatrixXf gather(const MatrixXf& points, std::span<const uint32_t> members, const VectorXf& mean) {
    MatrixXf block(points.rows(), static_cast<Index>(members.size()));
    for (size_t m = 0; m < members.size(); ++m) {
        block.col(static_cast<Index>(m)) = points.col(static_cast<Index>(members[m])) - mean;
    }
    return block;
}

template <typename Body>
void for_member_blocks(const MatrixXf& points, std::span<const uint32_t> members,
                       const VectorXf& mean, Body&& body) {
    for (size_t m = 0; m < members.size(); m += kMembersAtOnce) {
        const auto some = members.subspan(m, std::min(kMembersAtOnce, members.size() - m));
        body(gather(points, some, mean));
    }
}

MatrixXf orthonormal(const MatrixXf& columns) {
    const Eigen::HouseholderQR<MatrixXf> qr(columns);
    return qr.householderQ() * MatrixXf::Identity(columns.rows(), columns.cols());
}

struct Principal {
    MatrixXf basis;           // [d][m]
    VectorXf inverse_spread;  // [m]
};

// Turns the basis to the members' principal directions in it, and drops those without spread.
Principal principal_within(const MatrixXf& points, std::span<const uint32_t> members,
                           const VectorXf& mean, const MatrixXf& basis) {
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(basis.cols(), basis.cols());
    for_member_blocks(points, members, mean, [&](const MatrixXf& block) {
        const Eigen::MatrixXd factors = (basis.transpose() * block).cast<double>();
        gram.noalias() += factors * factors.transpose();
    });
    const Eigenpairs all = all_eigenpairs(gram);
    const Index size = gram.rows();
    // Floats give amplitudes to some 2^-20 of the largest: what is below is not the members'.
    const double floor = size == 0 ? 0.0 : 0x1p-40 * all.values[0];
    Index kept = 0;
    while (kept < size && all.values[kept] > floor) ++kept;
    return {basis * all.vectors.leftCols(kept).cast<float>(),
            all.values.head(kept).cwiseInverse().cast<float>()};
}

}  // namespace

ClusterSubspaces::ClusterSubspaces(Index num_dimensions, uint32_t num_clusters,
                                   uint32_t num_components)
    : num_clusters_(num_clusters),
      num_components_(num_components),
      columns_(MatrixXf::Zero(num_dimensions, static_cast<Index>(num_clusters) *
                                                  static_cast<Index>(num_components + 1))),
      products_(VectorXf::Zero(columns_.cols())),
      inverse_spread_(VectorXf::Zero(columns_.cols())) {}

uint64_t ClusterSubspaces::fit_scratch_bytes(uint64_t num_dimensions, uint64_t num_components) {
    // A block of members and its products with the basis.
    return kMembersAtOnce * (num_dimensions + num_components) * sizeof(float);
}

void ClusterSubspaces::set_mean(uint32_t c, const VectorXf& mean) {
    const Index first = static_cast<Index>(c) * static_cast<Index>(num_components_ + 1);
    columns_.col(first) = mean;
    products_.segment(first, num_components_ + 1) =
        columns_.middleCols(first, num_components_ + 1).transpose() * mean;
}

ClusterSubspaces ClusterSubspaces::with_components(uint32_t num_components) const {
    PAIM_CHECK_LE(num_components_, num_components);
    ClusterSubspaces other(columns_.rows(), num_clusters_, num_components);
    const Index step = static_cast<Index>(num_components_) + 1;
    const Index other_step = static_cast<Index>(num_components) + 1;
    for (Index c = 0; c < static_cast<Index>(num_clusters_); ++c) {
        other.columns_.middleCols(c * other_step, step) = columns_.middleCols(c * step, step);
        other.products_.segment(c * other_step, step) = products_.segment(c * step, step);
        other.inverse_spread_.segment(c * other_step, step) =
            inverse_spread_.segment(c * step, step);
    }
    return other;
}

ClusterSubspaces ClusterSubspaces::means() const {
    ClusterSubspaces other(columns_.rows(), num_clusters_, 0);
    const Index step = static_cast<Index>(num_components_) + 1;
    for (uint32_t c = 0; c < num_clusters_; ++c) {
        other.set_mean(c, columns_.col(static_cast<Index>(c) * step));
    }
    return other;
}

float ClusterSubspaces::leverage(uint32_t c, const Eigen::Ref<const VectorXf>& x) const {
    const Index first = static_cast<Index>(c) * static_cast<Index>(num_components_ + 1);
    const auto count = static_cast<Index>(num_components_);
    const VectorXf factors =
        columns_.middleCols(first + 1, count).transpose() * x - products_.segment(first + 1, count);
    return inverse_spread_[first] +
           factors.cwiseAbs2().dot(inverse_spread_.segment(first + 1, count));
}

void ClusterSubspaces::fit_cluster(const MatrixXf& points, const ClusterMembers& members, size_t c,
                                   uint64_t seed) {
    const auto own = members.of(c);
    if (own.empty()) return;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.rows());
    for (const uint32_t v : own) sum += points.col(static_cast<Index>(v)).cast<double>();
    const VectorXf mean = (sum / static_cast<double>(own.size())).cast<float>();
    const Index first = static_cast<Index>(c) * static_cast<Index>(num_components_ + 1);
    const Index count = std::min(
        {static_cast<Index>(num_components_), points.rows(), static_cast<Index>(own.size()) - 1});
    if (count > 0) {
        constexpr int kFirstSteps = 4, kSteps = 2;
        MatrixXf basis = columns_.middleCols(first + 1, count);
        int steps = kSteps;
        RandomStream random(stream_key(seed, c, 1));
        for (Index k = 0; k < count; ++k) {
            if (basis.col(k).squaredNorm() > 0.5f) continue;
            steps = kFirstSteps;
            for (float& x : basis.col(k)) x = static_cast<float>(random.uniform() - 0.5);
        }
        for (int step = 0; step < steps; ++step) {
            MatrixXf next = MatrixXf::Zero(basis.rows(), count);
            for_member_blocks(points, own, mean, [&](const MatrixXf& block) {
                const MatrixXf factors = block.transpose() * basis;
                next.noalias() += block * factors;
            });
            basis = orthonormal(next);
        }
        const Principal kept = principal_within(points, own, mean, basis);
        columns_.middleCols(first + 1, kept.basis.cols()) = kept.basis;
        columns_.middleCols(first + 1 + kept.basis.cols(), num_components_ - kept.basis.cols())
            .setZero();
        inverse_spread_.segment(first + 1, num_components_).setZero();
        inverse_spread_.segment(first + 1, kept.basis.cols()) = kept.inverse_spread;
    } else {
        columns_.middleCols(first + 1, num_components_).setZero();
        inverse_spread_.segment(first + 1, num_components_).setZero();
    }
    inverse_spread_[first] = 1.0f / static_cast<float>(own.size());
    set_mean(static_cast<uint32_t>(c), mean);
}

void ClusterSubspaces::fit(const MatrixXf& points, const ClusterMembers& members, uint64_t seed) {
    PAIM_CHECK_EQ(members.num_clusters(), num_clusters_);
    parallel_for(num_clusters_, 1,
                 [&](size_t c, size_t) { fit_cluster(points, members, c, seed); });
}

}  // namespace paim
