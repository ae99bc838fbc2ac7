// Rebuilds poses from a compressed animation.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "paim/codec/basis_table.h"
#include "paim/transfer/layout.h"

namespace paim {

// What of a model to use; larger numbers than it has mean all, and at least one band is kept.
struct DecodeLimits {
    uint32_t geometry_components = std::numeric_limits<uint32_t>::max();
    uint32_t transfer_components = std::numeric_limits<uint32_t>::max();
    uint32_t bands = std::numeric_limits<uint32_t>::max();
    uint32_t cluster_components = std::numeric_limits<uint32_t>::max();  // of clustered transfer
};

// One rebuilt pose.
struct DecodedPose {
    TransferLayout layout;         // bands as limited
    std::vector<float> positions;  // [3][V] scene units
    std::vector<float> transfer;   // [layout.num_planes()][V]
    // Work space of clustered transfer, kept from frame to frame.
    std::vector<float> basis_rows = {};  // [layout.num_planes()][rows of all bases]
    BasisTable row_table = {};
};

class Decoder {
  public:
    virtual ~Decoder() = default;

    virtual uint32_t num_vertices() const = 0;
    virtual uint32_t num_poses() const = 0;

    // Rebuilds the pose at `time` in poses: 0 … P−1, fractions interpolate the weights linearly;
    // clamped to that range. Reuses what `out` holds.
    virtual void decode(double time, const DecodeLimits& limits, DecodedPose& out) const = 0;
};

}  // namespace paim
