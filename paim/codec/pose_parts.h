// The two halves of a decoded pose, for decoders.
#pragma once

#include <vector>

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim {

// Sets out.positions.
void decode_positions(const Model& model, double time, const DecodeLimits& limits,
                      DecodedPose& out);

// The transfer of every point of the transfer's matrix (a vertex, or a row of a basis).
// layout  the model's, bands as limited
// out     [layout.num_planes()][points]
void decode_transfer_points(const Model& model, double time, const DecodeLimits& limits,
                            TransferLayout& layout, std::vector<float>& out);

}  // namespace paim
