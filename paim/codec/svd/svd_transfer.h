// Codec svd: each vertex has its own components, and decoding is M + U·W, plane by plane.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include "paim/codec/frame_cost.h"
#include "paim/codec/transfer_model.h"
#include "paim/codec/transfer_player.h"

namespace paim {

// The points of the matrix are the vertices.
class SvdTransfer : public TransferModel {
  public:
    static constexpr std::string_view kName = "svd";

    SvdTransfer() = default;
    explicit SvdTransfer(LowRank planes) : TransferModel(std::move(planes)) {}

    std::string_view codec_name() const override { return kName; }
    std::unique_ptr<TransferModel> clone() const override;
    uint32_t num_vertices() const override { return matrix.num_points; }
    bool points_are_vertices() const override { return true; }
    FrameCost cost(const TransferLayout& layout, const DecodeLimits& limits,
                   bool coloured_light) const override;
    uint32_t start(uint32_t num_vertices) override { return num_vertices; }
};

// Cost of a frame. A vertex rebuilds all its coefficients, (K + 1) multiply-adds each, and
// multiplies them by the light.
FrameCost svd_cost(const TransferLayout& layout, uint32_t num_components, bool coloured_light);

}  // namespace paim
