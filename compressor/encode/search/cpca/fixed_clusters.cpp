// Codec cpca with a given number of clusters.
#include "compressor/encode/search/cpca/fixed_clusters.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "compressor/encode/search/cpca/clustered_quantise.h"
#include "compressor/encode/search/cpca/clusterings.h"
#include "compressor/encode/search/cpca/cpca_memory.h"
#include "paim/codec/cpca/cpca_transfer.h"

namespace paim {

namespace {

// Of squared errors: 1 % of the error.
constexpr double kAddedBySteps = 0.02;
// Squares of the transfer that steps may take where nothing else is lost.
constexpr double kLeastSquares = 1e-8;

}  // namespace

CodedTransfer code_clusters(const TransferSearchTask& task, uint32_t num_clusters) {
    const EncodeProblem& problem = task.problem;
    const auto most = std::min<uint64_t>(most_clusters(problem.transfer.num_points), kMaxClusters);
    const auto count = static_cast<uint32_t>(std::min<uint64_t>(num_clusters, most));
    const std::shared_ptr<Clusterings> clusterings = clusterings_of(task.memos);
    const std::shared_ptr<const ClusteredPca> pca =
        clusterings->find(problem, count, kUsualAssumedComponents, problem.spare_bytes);
    const ClusteredFactors bases =
        cluster_bases(problem.transfer, problem.plane_weight, *pca, kUsualAssumedComponents);
    Quantiser quantiser{1.0, problem.transfer.num_components(), problem.plane_weight};
    const double added =
        std::max(kAddedBySteps * bases.truncated, kLeastSquares * problem.transfer_energy);
    const double step = largest_step(bases, quantiser, bases.truncated + added);
    quantiser.step = step > 0.0 ? step : smallest_step(bases, quantiser);
    ClusteredMatrix quantised = quantise_clusters(bases, quantiser);
    return CpcaTransfer(std::move(quantised.matrix), std::move(quantised.clusters));
}

}  // namespace paim
