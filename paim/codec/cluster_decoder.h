// The decoder of clustered PCA: bases at a time, then every vertex from its cluster's basis.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#pragma once

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim {

class ClusterDecoder : public Decoder {
  public:
    // Keeps a reference to the model, whose transfer is clustered (checked).
    explicit ClusterDecoder(const Model& model);

    uint32_t num_vertices() const override { return model_.topology.num_vertices; }
    uint32_t num_poses() const override { return model_.num_poses(); }
    void decode(double time, const DecodeLimits& limits, DecodedPose& out) const override;

  private:
    const Model& model_;
};

// Every vertex's values from values of the rows of its cluster's basis, on all threads.
// rows  [planes][clusters · (1 + components)], scales not applied
// out   [planes][V]
void combine_rows(const VertexClusters& clusters, std::span<const float> rows,
                  uint32_t num_components, std::span<float> out);

}  // namespace paim
