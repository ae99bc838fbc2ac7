// The reference decoder: M + U·W, plane by plane.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry, 2012
#pragma once

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim {

class SvdDecoder : public Decoder {
  public:
    // Keeps a reference to the model.
    explicit SvdDecoder(const Model& model) : model_(model) {}

    uint32_t num_vertices() const override { return model_.topology.num_vertices; }
    uint32_t num_poses() const override { return model_.num_poses(); }
    void decode(double time, const DecodeLimits& limits, DecodedPose& out) const override;

  private:
    const Model& model_;
};

// The weights of all components at `time` (in poses, clamped to 0 … P−1), linearly interpolated.
// weights [K]
void interpolate_weights(const LowRankMatrix& matrix, double time, std::vector<float>& weights);

}  // namespace paim
