// How much memory the search for clusters takes.
#include "compressor/encode/search/cpca/cpca_memory.h"

#include "compressor/encode/cluster/clustered_pca.h"

namespace paim {

namespace {

// The shape of the points that clusters are made of, without their values.
class Dimensions : public PointSource {
  public:
    explicit Dimensions(const TargetSize& size)
        : num_points_(static_cast<uint32_t>(size.streamed.num_vertices)),
          num_planes_(size.num_planes),
          num_columns_(size.transfer_components + 1) {}

    uint32_t num_points() const override { return num_points_; }
    uint32_t num_planes() const override { return num_planes_; }
    uint32_t num_columns() const override { return num_columns_; }
    void read(uint32_t, Eigen::Ref<Eigen::MatrixXf>) const override {}

  private:
    uint32_t num_points_, num_planes_, num_columns_;
};

}  // namespace

CodecMemory cpca_memory(const TargetSize& size) {
    const uint64_t num_vertices = size.streamed.num_vertices;
    const uint64_t num_clusters =
        std::min<uint64_t>(kClusterCounts.back(), most_clusters(num_vertices));
    ClusteringOptions options;
    options.num_clusters = static_cast<uint32_t>(num_clusters);
    options.assumed_components = kMaxAssumedComponents;
    options.max_components = kMaxSearchedComponents;
    CodecMemory memory;
    // A point is a row of a basis. Codings of more rows than this are not tried.
    memory.num_points = std::min(2 * num_vertices, num_clusters * (kMaxSearchedComponents + 1));
    memory.num_points_each = kMaxSearchedComponents + 1;
    memory.kept_bytes = kMaxClusterings * ClusteredPca::held_bytes(num_vertices, num_clusters,
                                                                   kMaxSearchedComponents) +
                        num_vertices * options.num_dimensions() * sizeof(float);
    memory.preparing_bytes = clustered_pca_memory_bytes(Dimensions(size), options);
    memory.coding_bytes = memory.num_points * size.num_planes *
                          (size.transfer_components + uint64_t{1}) * sizeof(float);
    return memory;
}

}  // namespace paim
