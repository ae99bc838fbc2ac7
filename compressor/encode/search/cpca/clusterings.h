// Clusterings of the vertices of a problem, which stay until they are not needed any more.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "compressor/encode/cluster/clustered_pca.h"
#include "compressor/encode/search/problem.h"
#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

// A clustering depends on the problem's transfer, on its number of clusters and on the dimension of
// the subspaces alone, so it does not matter in which order they are asked for.
class Clusterings : public CodecMemo {
  public:
    std::shared_ptr<const ClusteredPca> find(const EncodeProblem& problem, uint32_t num_clusters,
                                             uint32_t subspace_dimension, uint64_t memory_bytes);

    // Lets go of one that nothing else holds either, so that there is memory for others.
    void forget(uint32_t num_clusters, uint32_t subspace_dimension) {
        found_.erase({num_clusters, subspace_dimension});
    }

  private:
    Eigen::MatrixXf projected_;  // points, once any were clustered
    std::map<std::pair<uint32_t, uint32_t>, std::shared_ptr<const ClusteredPca>> found_;
};

// Those of a series of searches, or new ones.
std::shared_ptr<Clusterings> clusterings_of(CodecMemos* memos);

}  // namespace paim
