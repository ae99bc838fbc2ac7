// The transfer of a bake's poses, baked again with many more rays.
#pragma once

#include <cstdint>
#include <optional>

#include "compressor/bake/transfer_baker.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Rays of the truth by those of the bake, but at most kMostTruthRays. With 16 times the rays its noise is
// an eighth of the bake's (docs/results/noise.md); of bakes with more than 1024 rays it is more.
constexpr uint32_t kTruthRaysByRays = 16;
constexpr uint32_t kMostTruthRays = 1u << 14;

class TransferTruth {
  public:
    // Keeps a reference to the bake.
    explicit TransferTruth(const BakeReader& bake);

    uint32_t rays() const { return rays_; }

    // Pose p as baked, with this transfer; in coordinates and axes of the scene.
    DecodedPose pose(uint32_t p) const;

    // The still meshes with this transfer; nullptr if there are none.
    const DecodedPose* still() const { return still_ ? &*still_ : nullptr; }

  private:
    DecodedPose decoded(BakedPose baked) const;

    const BakeReader& bake_;
    uint32_t rays_;
    TransferBaker baker_;
    std::optional<DecodedPose> still_;
};

}  // namespace paim
