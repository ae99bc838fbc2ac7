// The transfer of a bake's poses, baked again with many more rays.
#pragma once

#include <cstdint>

#include "analysis/reference/rebaked_transfer.h"

namespace paim {

// Rays of the truth by those of the bake, but at most kMostTruthRays. With 16 times the rays its noise is
// an eighth of the bake's (docs/results/noise.md); of bakes with more than 1024 rays it is more.
constexpr uint32_t kTruthRaysByRays = 16;
constexpr uint32_t kMostTruthRays = 1u << 14;

class TransferTruth : public RebakedTransfer {
  public:
    // Keeps a reference to the bake.
    explicit TransferTruth(const BakeReader& bake);
};

}  // namespace paim
