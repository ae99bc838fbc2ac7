// The reference decoder: M + U·W, plane by plane.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry, 2012
#include "paim/codec/svd_decoder.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/codec/pose_parts.h"

namespace paim {

SvdDecoder::SvdDecoder(const Model& model) : model_(model) {
    PAIM_CHECK(model.clusters.empty());
}

void SvdDecoder::decode(double time, const DecodeLimits& limits, DecodedPose& out) const {
    decode_positions(model_, time, limits, out);
    decode_transfer_points(model_, time, limits, out.layout, out.transfer);
}

}  // namespace paim
