// Light before weights: clustered transfer meets the light in the bases that vertices share, so
// that a vertex costs a few multiply-adds a channel however many coefficients its transfer has.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#pragma once

#include <span>
#include <vector>

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"
#include "paim/light/light.h"

namespace paim {

// What the rows of all bases show under a light. Keeps its memory from one frame to the next.
class ClusterLight {
  public:
    // Keeps a reference to the model, whose transfer is clustered (checked).
    explicit ClusterLight(const Model& model);

    // products[r] = scales[r] · Σ_i row_i(time) L_i per channel, of every row r of every cluster;
    // zero for components of clusters beyond the limits. Bands beyond the light's are taken as zero.
    // time      in poses, as Decoder::decode() takes it
    // products  [clusters · (1 + components)] linear RGB
    void basis_radiance(double time, const DecodeLimits& limits, const LightCoefficients& light,
                        std::vector<Vec3f>& products);

  private:
    const Model& model_;
    std::vector<float> weights_;
};

// radiance(v) = albedo(v) · (product(c, 0) + Σ_j coefficients[j][v] · product(c, 1 + j)), c being the
// vertex's cluster: what decode() and shade() give, to rounding.
// products        [rows], of basis_radiance()
// num_components  of clusters, in use
// radiance        [V] linear RGB
void shade_clusters(const VertexClusters& clusters, std::span<const Vec3f> products,
                    uint32_t num_components, const Albedo& albedo, std::vector<Vec3f>& radiance);

}  // namespace paim
