// The reference decoder: M + U·W, plane by plane.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry, 2012
#pragma once

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim {

class SvdDecoder : public Decoder {
  public:
    // Keeps a reference to the model, whose transfer is not clustered (checked).
    explicit SvdDecoder(const Model& model);

    uint32_t num_vertices() const override { return model_.topology.num_vertices; }
    uint32_t num_poses() const override { return model_.num_poses(); }
    void decode(double time, const DecodeLimits& limits, DecodedPose& out) const override;

  private:
    const Model& model_;
};

}  // namespace paim
