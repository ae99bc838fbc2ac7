// The transfer of a bake's poses, baked again with many more rays.
#pragma once

#include <cstdint>
#include <memory>

#include "compressor/bake/transfer_baker.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Rays of the truth by those of the bake, if that is not more than kMostTruthRays. Its noise is an
// eighth of the bake's (docs/results/noise.md).
constexpr uint32_t kTruthRaysByRays = 16;
constexpr uint32_t kMostTruthRays = 1u << 14;

class TransferTruth {
  public:
    // Keeps a reference to the bake.
    explicit TransferTruth(const BakeReader& bake);

    uint32_t rays() const { return rays_; }

    // Pose p as baked, with this transfer; in coordinates and axes of the scene.
    DecodedPose pose(uint32_t p) const;

  private:
    const BakeReader& bake_;
    uint32_t rays_;
    TransferBaker baker_;
};

}  // namespace paim
