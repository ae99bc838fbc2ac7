// Lights clustered transfer: the light is applied to the bases that vertices share, so that the
// cost of a vertex is a few multiply-adds a channel, whatever the number of coefficients of its
// transfer.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "paim/codec/cpca/basis_table.h"
#include "paim/codec/cpca/cluster_shading.h"
#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/transfer_player.h"

namespace paim {

class CpcaPlayer : public TransferPlayer {
  public:
    // Keeps a reference to the transfer.
    CpcaPlayer(const CpcaTransfer& transfer, const TransferLayout& layout);

    void decode(double time, const DecodeLimits& limits, TransferLayout& layout,
                std::vector<float>& transfer) override;
    void light(double time, const DecodeLimits& limits, const LightCoefficients& light,
               const Albedo& albedo, std::vector<Vec3f>& radiance) override;

    // The radiance of the rows of all bases under a light:
    //   basis_radiance[o][r] = scales[r] · Σ_i row_r,oi(time) L_i
    // per channel, of every row r of every cluster and every outgoing coefficient o; zero for components of clusters beyond the
    // limits. Bands that the light does not have are zero. After the first call, calls with the
    // same time and limits only apply the light.
    // time            in poses, as decode() takes it
    // basis_radiance  [num_outgoing][clusters · (1 + components)] linear RGB
    void basis_radiance(double time, const DecodeLimits& limits, const LightCoefficients& light,
                        std::vector<Vec3f>& basis_radiance);

  private:
    const CpcaTransfer& transfer_;
    const TransferLayout layout_;
    PointDecoder points_;
    std::vector<float> values_;  // [planes][rows]
    BasisTable table_;
    std::vector<float> weights_;
    // The time of the pose that was lit last. Its rows are kept from the second time that it is
    // lit.
    std::optional<double> time_;
    DecodeLimits limits_;
    std::vector<float> pose_rows_;
    std::vector<Vec3f> radiance_;
    std::optional<ClusterShading> shading_;  // made when vertices are first lit
};

}  // namespace paim
