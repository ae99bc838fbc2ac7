// Clusterings of the vertices of a problem.
#include "compressor/encode/search/cpca/clusterings.h"

#include "compressor/encode/cluster/point_projection.h"
#include "compressor/encode/search/cpca/clustered_quantise.h"
#include "compressor/encode/search/cpca/cpca_memory.h"
#include "paim/codec/cpca/cpca_transfer.h"

namespace paim {

std::shared_ptr<const ClusteredPca> Clusterings::find(const EncodeProblem& problem,
                                                      uint32_t num_clusters,
                                                      uint32_t subspace_dimension,
                                                      uint64_t memory_bytes) {
    std::shared_ptr<const ClusteredPca>& found = found_[{num_clusters, subspace_dimension}];
    if (found) return found;
    ClusteringOptions options;
    options.num_clusters = num_clusters;
    options.assumed_components = subspace_dimension;
    options.max_components = searched_components(subspace_dimension);
    options.memory_bytes = memory_bytes;
    const FactorPoints points(problem.transfer, problem.plane_weight);
    if (projected_.size() == 0) {
        projected_ = project_points(points, options.num_dimensions(), options.seed);
    }
    found = std::make_shared<const ClusteredPca>(
        clustered_pca(points, projected_, options, problem.bake.directory().string()));
    return found;
}

std::shared_ptr<Clusterings> clusterings_of(CodecMemos* memos) {
    if (memos == nullptr) return std::make_shared<Clusterings>();
    std::shared_ptr<CodecMemo>& memo = (*memos)[std::string(CpcaTransfer::kName)];
    if (!memo) memo = std::make_shared<Clusterings>();
    return std::static_pointer_cast<Clusterings>(memo);
}

}  // namespace paim
