// Codec cpca, clustered PCA: vertices of a cluster share a basis, so that light and pose can be
// applied to the bases instead of to every vertex.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#pragma once

#include "paim/codec/cpca/vertex_clusters.h"
#include "paim/codec/frame_cost.h"
#include "paim/codec/section_row.h"
#include "paim/codec/transfer_model.h"
#include "paim/codec/transfer_player.h"

namespace paim {

// The points of the matrix are the rows of all bases.
class CpcaTransfer : public TransferModel {
  public:
    static constexpr std::string_view kName = "cpca";

    CpcaTransfer() = default;
    CpcaTransfer(LowRank bases, VertexClusters vertices)
        : TransferModel(std::move(bases)), clusters(std::move(vertices)) {}

    std::string_view codec_name() const override { return kName; }
    std::unique_ptr<TransferModel> clone() const override;
    uint32_t num_vertices() const override {
        return static_cast<uint32_t>(clusters.cluster.size());
    }
    uint32_t num_vertex_components() const override { return clusters.num_components; }
    void vertices_from_points(std::span<const float> points, uint32_t num_components,
                              std::span<float> out) const override;
    std::unique_ptr<TransferPlayer> make_player(const TransferLayout& layout) const override;
    FrameCost cost(const TransferLayout& layout, const DecodeLimits& limits,
                   bool coloured_light) const override;
    uint64_t vertex_bytes(uint32_t num_components) const override;
    double vertex_gain() const override;
    std::optional<PointGroups> point_groups() const override;

    std::vector<NamedNumber> numbers() override;
    uint32_t start(uint32_t num_vertices) override;
    std::vector<SectionRow> sections() override;
    bool always_packed() const override { return true; }

    VertexClusters clusters;

  private:
    uint32_t num_stored_vertices_ = 0;  // of a file that is being read
};

// Cost of a frame. The mean and the K components of each cluster are multiplied by the light once a
// frame. Then a vertex costs K + 1 multiply-adds a channel and outgoing coefficient, light included.
// num_time_components  whose weighted sums are the clusters' bases of a pose; 0: the bases are the
//                      same in all poses
FrameCost cpca_cost(const TransferLayout& layout, uint32_t num_clusters, uint32_t num_components,
                    uint32_t num_time_components, bool coloured_light);

}  // namespace paim
